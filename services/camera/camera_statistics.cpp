#include "services/camera/camera_statistics.hpp"

namespace tsg {
namespace {

nlohmann::json to_json(const SampleWindow& window) {
  const Summary summary = window.summary();
  return {{"count", summary.count},
          {"p50", summary.median},
          {"p99", summary.p99},
          {"max", summary.max}};
}

}  // namespace

nlohmann::json CameraStatistics::to_json() const {
  return {{"frames_sent", frames_sent},
          {"frames_late", frames_late},
          {"frames_dropped_pool", frames_dropped_pool},
          {"decode_ms", tsg::to_json(decode_ms)},
          {"behind_ms", tsg::to_json(behind_ms)}};
}

}  // namespace tsg
