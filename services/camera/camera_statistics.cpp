#include "services/camera/camera_statistics.hpp"

#include "common/app/sample_window_json.hpp"

namespace tsg {

nlohmann::json CameraStatistics::to_json() const {
  return {{"frames_sent", frames_sent},
          {"frames_late", frames_late},
          {"frames_dropped_pool", frames_dropped_pool},
          {"decode_ms", tsg::to_json(decode_ms)},
          {"behind_ms", tsg::to_json(behind_ms)}};
}

}  // namespace tsg
