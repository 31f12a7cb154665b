#pragma once

#include <cstdint>
#include <optional>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/tracker.hpp"

namespace tsg {

/// Where the camera is, in the frames that robot software knows (docs/glossary.md): `map` may jump
/// when the map is corrected, `odom` never does, T_map_odom takes up the difference.
struct OdometryPose {
  std::int64_t stamp_ns = 0;
  SE3 T_map_camera;
  SE3 T_odom_camera;
  SE3 T_map_odom;
  /// How uncertain the pose is, in the axes of `odom`: position (m), then rotation about the fixed
  /// axes (rad), as ROS has it. Of this frame in the map as it is: drift is not in it.
  Matrix6d covariance = Matrix6d::Zero();
  /// Velocity of the camera in its own axes (m/s, then rad/s); absent after a gap.
  std::optional<Vector6d> twist_camera;
};

/// Turns tracking results, whose world is the optical frame of the first keyframe, into poses in
/// `map` and `odom`, whose axes are x forward, y left, z up for a camera that started level.
class Odometry {
 public:
  /// Nothing where the result has no pose. Call with the results in their order.
  std::optional<OdometryPose> update(const TrackResult& result);

  /// From the optical axes of the first keyframe to the axes of `map`.
  [[nodiscard]] static SE3 T_map_world();

 private:
  struct Last {
    std::int64_t stamp_ns;
    KeyframeId reference;
    SE3 T_reference_camera;
    SE3 T_world_camera;
  };
  [[nodiscard]] static SE3 motion_since(const Last& last, const TrackResult& result);

  std::optional<Last> last_;  // the previous result, if it had a pose
  SE3 T_odom_camera_ = T_map_world();
};

}  // namespace tsg
