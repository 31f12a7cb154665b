#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/se3.hpp"

namespace tsg {

/// Where the camera was at one time; metres.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  SE3 T_world_camera;
};

using Trajectory = std::vector<StampedPose>;  ///< sorted by stamp, no stamp twice

}  // namespace tsg
