#include "services/slam/lib/motion_prior.hpp"

#include <Eigen/Cholesky>

namespace tsg {
namespace {

constexpr double kAcceleration = 3.0;          // m/s^2: a camera in the hand, a robot that bumps
constexpr double kAngularAcceleration = 12.0;  // rad/s^2
constexpr double kUnknownSpeed = 1.0;          // m/s: of a camera of which one pose is known
constexpr double kUnknownTurn = 2.0;           // rad/s
/// Errors of matches have a part in common, which their covariance does not know of.
constexpr double kErrorGrowth = 2.0;
constexpr double kFloor = 1e-7;  // m^2 or rad^2: no pose is known better

constexpr double kChiSquare = 12.6;  // 95 % of 6 degrees of freedom

Vector6d for_each_axis(double translation, double rotation) {
  Vector6d values;
  values << Eigen::Vector3d::Constant(translation), Eigen::Vector3d::Constant(rotation);
  return values;
}

Matrix6d inverse(const Matrix6d& positive) { return positive.ldlt().solve(Matrix6d::Identity()); }

/// What is to be allowed for in a pose with that covariance.
Matrix6d doubted(const Matrix6d& covariance) {
  return kErrorGrowth * covariance + kFloor * Matrix6d::Identity();
}

}  // namespace

void CameraMotion::start(const SE3& T_camera_world, const Matrix6d& covariance) {
  T_camera_world_ = T_camera_world;
  twist_per_second_.setZero();
  covariance_.setZero();
  covariance_.topLeftCorner<6, 6>() = doubted(covariance);
  covariance_.diagonal().tail<6>() = for_each_axis(kUnknownSpeed, kUnknownTurn).cwiseAbs2();
}

SE3 CameraMotion::pose_after(double seconds) const {
  return SE3::exp(seconds * twist_per_second_) * T_camera_world_;
}

CameraMotion::Matrix12d CameraMotion::covariance_after(double seconds) const {
  Matrix12d F = Matrix12d::Identity();
  F.topRightCorner<6, 6>().diagonal().setConstant(seconds);
  Matrix12d after = F * covariance_ * F.transpose();
  const Vector6d speed = seconds * for_each_axis(kAcceleration, kAngularAcceleration);
  const Vector6d path = 0.5 * seconds * speed;
  after.topLeftCorner<6, 6>().diagonal() += path.cwiseAbs2();
  after.bottomRightCorner<6, 6>().diagonal() += speed.cwiseAbs2();
  after.topRightCorner<6, 6>().diagonal() += path.cwiseProduct(speed);
  after.bottomLeftCorner<6, 6>().diagonal() += path.cwiseProduct(speed);
  return after;
}

PosePrior CameraMotion::predict(double seconds) const {
  return {.T_camera_world = pose_after(seconds),
          .information = inverse(covariance_after(seconds).topLeftCorner<6, 6>())};
}

void CameraMotion::add(const SE3& T_camera_world, const Matrix6d& covariance, double seconds) {
  const Matrix12d expected = covariance_after(seconds);
  const SE3 T_expected_world = pose_after(seconds);
  const Vector6d surprise = (T_camera_world * T_expected_world.inverse()).log();
  const Matrix6d S = expected.topLeftCorner<6, 6>() + doubted(covariance);
  if (surprise.dot(S.ldlt().solve(surprise)) > kChiSquare) {
    const Vector6d twist = (T_camera_world * T_camera_world_.inverse()).log();
    start(T_camera_world, covariance);
    if (seconds > 0.0) twist_per_second_ = twist / seconds;
    return;
  }
  const Eigen::Matrix<double, 12, 6> gain = expected.leftCols<6>() * inverse(S);
  const Eigen::Matrix<double, 12, 1> change = gain * surprise;
  T_camera_world_ = SE3::exp(change.head<6>()) * T_expected_world;
  twist_per_second_ += change.tail<6>();
  const Matrix12d left = expected - gain * S * gain.transpose();
  covariance_ = 0.5 * (left + left.transpose());  // rounding would add up to a lopsided one
}

void CameraMotion::move_world(const SE3& T_moved_world) {
  T_camera_world_ = T_camera_world_ * T_moved_world.inverse();
}

bool agrees_with_motion(const PosePrior& prior, const PoseEstimate& estimate) {
  if (prior.information.isZero()) return false;
  const Vector6d difference = (estimate.T_camera_world * prior.T_camera_world.inverse()).log();
  const Matrix6d allowed = inverse(prior.information) + doubted(estimate.covariance);
  return difference.dot(allowed.ldlt().solve(difference)) < kChiSquare;
}

}  // namespace tsg
