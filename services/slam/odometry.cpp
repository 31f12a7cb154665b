#include "services/slam/odometry.hpp"

#include "common/core/time.hpp"

namespace tsg {
namespace {

/// Covariance of a pose T_a_camera in the axes of a, from that of a left-hand twist of its inverse.
Matrix6d in_axes_of(const SE3& T_a_camera, const Matrix6d& covariance) {
  // exp(xi) * T_camera_a moves the camera by -R_a_camera * xi.
  Matrix6d to_a = Matrix6d::Zero();
  to_a.topLeftCorner<3, 3>() = T_a_camera.rotation_matrix();
  to_a.bottomRightCorner<3, 3>() = T_a_camera.rotation_matrix();
  return to_a * covariance * to_a.transpose();
}

}  // namespace

SE3 Odometry::T_map_world() {
  Eigen::Matrix3d R_map_world;
  R_map_world << 0.0, 0.0, 1.0,  // forward is the optical z
      -1.0, 0.0, 0.0,            // left is the optical -x
      0.0, -1.0, 0.0;            // up is the optical -y
  return {R_map_world, Eigen::Vector3d::Zero()};
}

SE3 Odometry::motion_since(const Last& last, const TrackResult& result) {
  // Relative to one keyframe the motion is free of what mapping did to the map in between.
  if (last.reference == result.reference) {
    return last.T_reference_camera.inverse() * result.T_reference_camera;
  }
  // Tracking knows both poses in one map, even where the map was corrected in between.
  if (result.T_previous_camera) return *result.T_previous_camera;
  return last.T_world_camera.inverse() * *result.T_world_camera;
}

std::optional<OdometryPose> Odometry::update(const TrackResult& result) {
  if (!result.T_world_camera) {
    last_.reset();
    return std::nullopt;
  }
  OdometryPose pose;
  pose.stamp_ns = result.stamp_ns;
  // After a gap odom goes on from where it was: how the camera moved meanwhile is not known.
  if (last_ && !result.relocalised) {
    const SE3 T_last_camera = motion_since(*last_, result);
    T_odom_camera_ = T_odom_camera_ * T_last_camera;
    const double elapsed_s = to_seconds(result.stamp_ns - last_->stamp_ns);
    if (elapsed_s > 0.0) pose.twist_camera = T_last_camera.log() / elapsed_s;
  }
  pose.T_map_camera = T_map_world() * *result.T_world_camera;
  pose.T_odom_camera = T_odom_camera_;
  pose.covariance = in_axes_of(T_odom_camera_, result.covariance);
  pose.T_map_odom = pose.T_map_camera * T_odom_camera_.inverse();
  last_ = {result.stamp_ns, result.reference, result.T_reference_camera, *result.T_world_camera};
  return pose;
}

}  // namespace tsg
