#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "common/core/sample_window.hpp"
#include "services/slam/lib/tracker.hpp"
#include "services/slam/stage_times.hpp"

namespace tsg {

/// What the service counts and measures, for reports and diagnostics.
struct NodeStatistics {
  std::uint64_t frames_tracked = 0;
  std::uint64_t frames_lost = 0;
  std::uint64_t frames_rejected = 0;
  std::uint64_t frames_dropped = 0;  ///< holes in what the camera sent
  std::uint64_t keyframes_sent = 0;
  std::uint64_t keyframes_failed = 0;  ///< no shared memory to send them in
  std::uint64_t keyframes_without_mask = 0;
  std::uint64_t keyframes_elsewhere = 0;  ///< in parts of the map that are not joined with it yet
  std::uint64_t masks_received = 0;
  SampleWindow extract_ms;
  SampleWindow match_ms;
  SampleWindow optimise_ms;
  SampleWindow total_ms;
  SampleWindow latency_ms;
  SampleWindow mask_age_frames;

  void add(const TrackResult& result, const FrameTimes& times);
  [[nodiscard]] nlohmann::json to_json() const;
};

}  // namespace tsg
