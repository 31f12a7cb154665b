#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "common/core/sample_window.hpp"

namespace tsg {

/// What the camera counts and measures, since its start.
struct CameraStatistics {
  std::uint64_t frames_sent = 0;
  std::uint64_t frames_late = 0;          ///< dropped: more than a period behind
  std::uint64_t frames_dropped_pool = 0;  ///< dropped: no shared memory was free
  SampleWindow decode_ms;
  SampleWindow behind_ms;  ///< how late frames went out; realtime only

  /// The answer to `report`.
  [[nodiscard]] nlohmann::json to_json() const;
};

}  // namespace tsg
