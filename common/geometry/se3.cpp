#include "common/geometry/se3.hpp"

#include <cmath>

namespace tsg {
namespace {

constexpr double kSmallAngle = 1e-6;  // below it the series are exact to double precision

/// Left Jacobian of SO(3): turns the translation part of a twist into a translation.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const Eigen::Matrix3d W = skew(rotation_vector);
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6.0;
  const double angle2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / angle2 * W +
         (angle - std::sin(angle)) / (angle2 * angle) * W * W;
}

Eigen::Vector3d rotation_log(const Eigen::Quaterniond& rotation) {
  // The quaternion and its negative are one rotation: take the one of the shorter way round.
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d vector = sign * rotation.vec();
  const double sine = vector.norm();
  if (sine < kSmallAngle) return 2.0 * vector;
  return 2.0 * std::atan2(sine, sign * rotation.w()) / sine * vector;
}

}  // namespace

Eigen::Isometry3d SE3::to_isometry() const {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = rotation_matrix();
  transform.translation() = translation_;
  return transform;
}

SE3 SE3::inverse() const {
  const Eigen::Quaterniond inverse_rotation = rotation_.conjugate();
  return {inverse_rotation, -(inverse_rotation * translation_)};
}

SE3 SE3::exp(const Vector6d& twist) {
  const Eigen::Vector3d rotation_vector = twist.tail<3>();
  const double angle = rotation_vector.norm();
  Eigen::Quaterniond rotation;
  if (angle < kSmallAngle) {
    rotation.w() = 1.0;
    rotation.vec() = 0.5 * rotation_vector;
  } else {
    rotation = Eigen::AngleAxisd(angle, rotation_vector / angle);
  }
  return {rotation, left_jacobian(rotation_vector) * twist.head<3>()};
}

Vector6d SE3::log() const {
  const Eigen::Vector3d rotation_vector = rotation_log(rotation_);
  Vector6d twist;
  twist << left_jacobian(rotation_vector).inverse() * translation_, rotation_vector;
  return twist;
}

double SE3::angle() const { return rotation_log(rotation_).norm(); }

Eigen::Matrix3d skew(const Eigen::Vector3d& vector) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -vector.z(), vector.y(),  //
      vector.z(), 0.0, -vector.x(),        //
      -vector.y(), vector.x(), 0.0;
  return matrix;
}

}  // namespace tsg
