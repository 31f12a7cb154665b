#pragma once

#include "services/slam/lib/pose_optimizer.hpp"

namespace tsg {

/// How the camera moves, by all of its poses until now: its speed stays, but for what a hand or a
/// wheel does to it (a Kalman filter over pose and speed, disturbed by white acceleration). Poses
/// that scatter, as they do where little is seen, so make a steady prediction.
class CameraMotion {
 public:
  /// From a pose on before which nothing is known. `covariance` as in PoseEstimate.
  void start(const SE3& T_camera_world, const Matrix6d& covariance);

  /// Where the camera is `seconds` later, and how surely.
  [[nodiscard]] PosePrior predict(double seconds) const;

  /// Takes in a pose `seconds` after the last, found by the view alone. One that the motion did not
  /// lead to is a jerk: it is believed, and the speed is learned anew.
  void add(const SE3& T_camera_world, const Matrix6d& covariance, double seconds);

  /// The world was moved: T_camera_world = T_camera_moved * T_moved_world.
  void move_world(const SE3& T_moved_world);

 private:
  using Matrix12d = Eigen::Matrix<double, 12, 12>;
  [[nodiscard]] SE3 pose_after(double seconds) const;
  [[nodiscard]] Matrix12d covariance_after(double seconds) const;

  SE3 T_camera_world_;
  Vector6d twist_per_second_ = Vector6d::Zero();  ///< left-hand, of T_camera_world
  Matrix12d covariance_ = Matrix12d::Identity();  ///< of both, the pose first
};

/// Whether a pose that was found without the prior may be one that the motion led to. Where not,
/// the camera was jerked and the prior is wrong, or the pose is.
[[nodiscard]] bool agrees_with_motion(const PosePrior& prior, const PoseEstimate& estimate);

}  // namespace tsg
