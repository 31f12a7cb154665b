#include "services/slam/lib/observation_model.hpp"

#include <algorithm>
#include <cmath>

namespace tsg {
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
