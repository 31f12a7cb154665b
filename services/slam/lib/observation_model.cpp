#include "services/slam/lib/observation_model.hpp"

#include <algorithm>
#include <cmath>
namespace tsg {
namespace {

constexpr double kPixelChiSquare = 9.21;   // 99 % quantile for two dimensions
constexpr double kMaxDepthResidual = 5.0;  // standard deviations: sensors err in heavy tails

}  // namespace

ObservationModel::ObservationModel(const CameraModel& camera, const SlamConfig& config)
    : camera_(camera),
      inverse_depth_weight_(1.0 / config.features.inverse_depth_sigma),
      log_scale_factor_(std::log(config.features.scale_factor)) {
  for (int level = 0; level < config.features.levels; ++level) {
    level_scales_.push_back(std::pow(config.features.scale_factor, level));
    pixel_weights_.push_back(1.0 / (config.tracker.pixel_sigma * level_scales_.back()));
  }
}

PointObservation ObservationModel::observe(const Feature& feature) const {
  return {feature.pixel.cast<double>(), feature.inverse_depth, pixel_weights_[feature.level]};
}

Eigen::Vector3d ObservationModel::residual(const PointObservation& observation,
                                           const Eigen::Vector3d& p_camera) const {
  Eigen::Vector3d residual;
  residual.head<2>() = observation.pixel_weight * (camera_.project(p_camera) - observation.pixel);
  residual.z() = observation.has_depth()
                     ? inverse_depth_weight_ * (1.0 / p_camera.z() - observation.inverse_depth)
                     : 0.0;
  return residual;
}

bool ObservationModel::is_inlier(const Eigen::Vector3d& residual) {
  return residual.head<2>().squaredNorm() <= kPixelChiSquare &&
         std::abs(residual.z()) <= kMaxDepthResidual;
}

Eigen::Matrix3d ObservationModel::point_jacobian(const PointObservation& observation,
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

int ObservationModel::level_at(double max_distance, double distance) const {
  const double level = std::ceil(std::log(max_distance / distance) / log_scale_factor_);
  return std::clamp(static_cast<int>(level), 0, levels() - 1);
}

Jacobian36 twist_jacobian(const Eigen::Vector3d& p_camera) {
  Jacobian36 J;
  J << Eigen::Matrix3d::Identity(), -skew(p_camera);
  return J;
}

}  // namespace tsg
