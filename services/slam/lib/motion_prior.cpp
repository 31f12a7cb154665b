#include "services/slam/lib/motion_prior.hpp"

#include <Eigen/Cholesky>

namespace tsg {
namespace {

constexpr double kAcceleration = 8.0;          // m/s^2: a camera in the hand, or a robot that bumps
constexpr double kAngularAcceleration = 30.0;  // rad/s^2
/// The prediction adds the last step to the last pose: the errors of both poses are in it.
constexpr double kErrorGrowth = 5.0;
constexpr double kFloor = 1e-8;  // m^2 or rad^2: no pose is known better

constexpr double kChiSquare = 12.6;  // 95 % of 6 degrees of freedom

}  // namespace

PosePrior prior_by_motion(const SE3& T_camera_world, const Matrix6d& covariance, double seconds) {
  const double translation = 0.5 * kAcceleration * seconds * seconds;
  const double rotation = 0.5 * kAngularAcceleration * seconds * seconds;
  Matrix6d predicted = kErrorGrowth * covariance;
  predicted.diagonal().head<3>().array() += translation * translation + kFloor;
  predicted.diagonal().tail<3>().array() += rotation * rotation + kFloor;
  return {.T_camera_world = T_camera_world,
          .information = predicted.ldlt().solve(Matrix6d::Identity())};
}

bool agrees_with_motion(const PosePrior& prior, const PoseEstimate& estimate) {
  if (prior.information.isZero()) return false;
  const Vector6d difference = (estimate.T_camera_world * prior.T_camera_world.inverse()).log();
  const Matrix6d allowed =
      prior.information.ldlt().solve(Matrix6d::Identity()) + estimate.covariance;
  return difference.dot(allowed.ldlt().solve(difference)) < kChiSquare;
}

}  // namespace tsg
