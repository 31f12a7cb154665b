#pragma once

#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <array>

#include "services/slam/lib/observation_model.hpp"

namespace tsg {

/// A pose as Ceres sees it: qx qy qz qw tx ty tz of T_camera_world.
using PoseBlock = std::array<double, 7>;

[[nodiscard]] PoseBlock to_pose_block(const SE3& T_camera_world);
[[nodiscard]] SE3 to_se3(const double* pose_block);

/// Steps of a pose are twists from the left: T <- exp(xi) * T. Derivatives by the block are written
/// as derivatives by xi in the first six columns (the seventh is zero), and PlusJacobian picks
/// these; so cost functions need no derivative by quaternion elements.
class LeftTwistManifold final : public ceres::Manifold {
 public:
  [[nodiscard]] int AmbientSize() const override { return 7; }
  [[nodiscard]] int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// ObservationModel::residual() of one sighting, by pose and point.
class ReprojectionCost final : public ceres::SizedCostFunction<3, 7, 3> {
 public:
  /// `model` must outlive the cost.
  ReprojectionCost(const ObservationModel& model, const PointObservation& observation)
      : model_(&model), observation_(observation) {}
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

 private:
  const ObservationModel* model_;
  PointObservation observation_;
};

}  // namespace tsg
