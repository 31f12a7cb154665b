#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "common/geometry/camera_model.hpp"
#include "common/geometry/se3.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// A sighting of a point: where, and how far if the sensor knows.
struct PointObservation {
  Eigen::Vector2d pixel;       ///< undistorted
  double inverse_depth = 0.0;  ///< 1/m; 0 = not measured
  double pixel_weight = 1.0;   ///< 1 / standard deviation, 1/pixels

  [[nodiscard]] bool has_depth() const { return inverse_depth > 0.0; }
};

using Jacobian36 = Eigen::Matrix<double, 3, 6>;

/// How a camera with depth sees points: pixel and inverse depth. Inverse depth takes the place of
/// the right image coordinate of a stereo camera (u_r = u - f b / z): it is what a structured-light
/// sensor measures, so its standard deviation is one number at all distances (Khoshelham and
/// Elberink 2012), and its error has nothing to do with that of the corner. Defined here where
/// the pose optimisation calls it for each match.
class ObservationModel {
 public:
  ObservationModel(const CameraModel& camera, const SlamConfig& config);

  [[nodiscard]] PointObservation observe(const Feature& feature) const;

  /// Standard deviations of pixel x, y and inverse depth that the point misses the observation by;
  /// the third is 0 where depth was not measured. `p_camera.z()` must be positive.
  [[nodiscard]] Eigen::Vector3d residual(const PointObservation& observation,
                                         const Eigen::Vector3d& p_camera) const {
    Eigen::Vector3d residual;
    residual.head<2>() = observation.pixel_weight * (camera_.project(p_camera) - observation.pixel);
    residual.z() = observation.has_depth()
                       ? inverse_depth_weight_ * (1.0 / p_camera.z() - observation.inverse_depth)
                       : 0.0;
    return residual;
  }

  /// Whether a residual is small enough for noise. Pixel and depth are judged apart: together, a
  /// good one would make up for a bad one.
  [[nodiscard]] static bool is_inlier(const Eigen::Vector3d& residual) {
    return residual.head<2>().squaredNorm() <= kPixelChiSquare &&
           std::abs(residual.z()) <= kMaxDepthResidual;
  }

  /// Derivative of residual() by the point.
  [[nodiscard]] Eigen::Matrix3d point_jacobian(const PointObservation& observation,
                                               const Eigen::Vector3d& p_camera) const {
    const double inverse_z = 1.0 / p_camera.z();
    const double x_weight = observation.pixel_weight * camera_.fx * inverse_z;
    const double y_weight = observation.pixel_weight * camera_.fy * inverse_z;
    const double z_weight = observation.has_depth() ? inverse_depth_weight_ : 0.0;
    Eigen::Matrix3d J;
    J << x_weight, 0.0, -x_weight * p_camera.x() * inverse_z,  //
        0.0, y_weight, -y_weight * p_camera.y() * inverse_z,   //
        0.0, 0.0, -z_weight * inverse_z * inverse_z;
    return J;
  }

  [[nodiscard]] const CameraModel& camera() const { return camera_; }
  /// Pixels of level 0 per pixel of `level`.
  [[nodiscard]] double level_scale(int level) const {
    return level_scales_[static_cast<std::size_t>(level)];
  }
  [[nodiscard]] double inverse_depth_sigma() const { return 1.0 / inverse_depth_weight_; }
  [[nodiscard]] int levels() const { return static_cast<int>(level_scales_.size()); }
  /// Level at which a thing last seen at `max_distance` in level 0 shows from `distance`.
  [[nodiscard]] int level_at(double max_distance, double distance) const;

 private:
  static constexpr double kPixelChiSquare = 9.21;   // 99 % quantile for two dimensions
  static constexpr double kMaxDepthResidual = 5.0;  // standard deviations: heavy tails

  CameraModel camera_;
  double inverse_depth_weight_;
  double log_scale_factor_;
  std::vector<double> level_scales_;
  std::vector<double> pixel_weights_;  ///< of each level
};

/// Derivative of p_camera by a small left-hand twist xi of the pose: exp(xi) * T_camera_world.
[[nodiscard]] Jacobian36 twist_jacobian(const Eigen::Vector3d& p_camera);

/// `J_point`, from point_jacobian(), times twist_jacobian(): without what is always 0 in both.
[[nodiscard]] inline Jacobian36 chain_with_twist(const Eigen::Matrix3d& J_point,
                                                 const Eigen::Vector3d& p_camera) {
  const double x = p_camera.x();
  const double y = p_camera.y();
  const double z = p_camera.z();
  const Eigen::Vector3d by_z = J_point.col(2);
  const double u_by_x = J_point(0, 0);
  const double v_by_y = J_point(1, 1);
  Jacobian36 J;
  J << u_by_x, 0.0, by_z[0], by_z[0] * y, u_by_x * z - by_z[0] * x, -u_by_x * y,  //
      0.0, v_by_y, by_z[1], by_z[1] * y - v_by_y * z, -by_z[1] * x, v_by_y * x,   //
      0.0, 0.0, by_z[2], by_z[2] * y, -by_z[2] * x, 0.0;
  return J;
}

}  // namespace tsg
