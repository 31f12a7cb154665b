#pragma once

#include <cstdint>
#include <vector>

#include "common/core/error.hpp"
#include "common/geometry/se3.hpp"
#include "common/geometry/stamped_pose.hpp"
#include "common/simulation/scene.hpp"

namespace tsg::simulation {

/// Where the camera is at any time: a smooth curve through waypoints or a recorded trajectory, and
/// the tremor of the hand that holds it.
class CameraPath {
 public:
  /// kBadData where there is no waypoint; the errors of read_trajectory() for a trajectory file.
  [[nodiscard]] static Expected<CameraPath> make(const CameraPathDescription& description,
                                                 std::uint64_t seed);

  /// Before the first and after the last waypoint it stays there.
  [[nodiscard]] SE3 T_world_camera(double time_s) const;

 private:
  /// A sine in one direction.
  struct Wave {
    double turns_per_s = 0.0;
    double phase_rad = 0.0;
    Vector6d amplitude = Vector6d::Zero();  ///< metres, radians
  };

  CameraPath() = default;
  [[nodiscard]] static std::vector<Wave> make_tremor(const CameraPathDescription& description,
                                                     std::uint64_t seed);
  [[nodiscard]] SE3 smooth_pose(double time_s) const;
  [[nodiscard]] SE3 recorded_pose(double time_s) const;

  std::vector<CameraWaypoint> waypoints_;
  std::vector<StampedPose> recorded_;
  std::vector<Wave> tremor_;
};

}  // namespace tsg::simulation
