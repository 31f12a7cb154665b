#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/core/statistics.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"

namespace tsg {

/// The last values of something measured again and again.
class RecentValues {
 public:
  void add(double value);
  [[nodiscard]] Summary summary() const { return summarise(values_); }

 private:
  static constexpr std::size_t kCapacity = 1000;  // half a minute of frames at 30 Hz
  std::vector<double> values_;
  std::size_t next_ = 0;  // to be overwritten once there are kCapacity
};

/// What the service has done since its start, for `report` and diagnostics.
struct SegmentationCounters {
  std::uint64_t taken = 0;     ///< frames taken up; each ends up in one of the next three
  std::uint64_t frames = 0;    ///< answered with a mask
  std::uint64_t failed = 0;    ///< withheld: rejected, not segmented or not published
  std::uint64_t given_up = 0;  ///< left without a mask on purpose, or as the service stops
  std::uint64_t left_out = 0;  ///< instances beyond what a message holds
  RecentValues preprocess_ms;
  RecentValues network_ms;
  RecentValues postprocess_ms;
  RecentValues total_ms;
  RecentValues input_age_ms;  ///< from the frame's publication to when it was taken up
  RecentValues latency_ms;    ///< from the frame's publication to its mask's

  std::string last_failure;  ///< why the last mask was withheld

  /// Frames that were taken up and neither answered nor given up yet.
  [[nodiscard]] std::uint64_t backlog() const { return taken - frames - failed - given_up; }

  void add(const SegmentationResult& result);
  /// For the command `report`.
  [[nodiscard]] nlohmann::json to_json() const;
};

}  // namespace tsg
