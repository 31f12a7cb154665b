#include "services/slam/lib/reprojection_cost.hpp"

#include <algorithm>

namespace tsg {
namespace {

constexpr double kSafeDepth = 0.02;  // metres; nearer, a step is refused as the projection blows up

using Jacobian37 = Eigen::Matrix<double, 3, 7, Eigen::RowMajor>;
using Jacobian33 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

}  // namespace

PoseBlock to_pose_block(const SE3& T_camera_world) {
  const Eigen::Quaterniond& q = T_camera_world.rotation();
  const Eigen::Vector3d& t = T_camera_world.translation();
  return {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
}

SE3 to_se3(const double* pose_block) {
  return {Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(pose_block)),
          Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(pose_block + 4))};
}

bool LeftTwistManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const SE3 moved = SE3::exp(Eigen::Map<const Vector6d>(delta)) * to_se3(x);
  const PoseBlock block = to_pose_block(moved);
  std::copy(block.begin(), block.end(), x_plus_delta);
  return true;
}

bool LeftTwistManifold::PlusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.topRows<6>().setIdentity();
  return true;
}

bool LeftTwistManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Vector6d>{y_minus_x} = (to_se3(y) * to_se3(x).inverse()).log();
  return true;
}

bool LeftTwistManifold::MinusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.leftCols<6>().setIdentity();
  return true;
}

bool ReprojectionCost::Evaluate(double const* const* parameters,
                                double* residuals,
                                double** jacobians) const {
  const SE3 T_camera_world = to_se3(parameters[0]);
  const Eigen::Vector3d p_world = Eigen::Map<const Eigen::Vector3d>(parameters[1]);
  const Eigen::Vector3d p_camera = T_camera_world * p_world;
  if (p_camera.z() < kSafeDepth) return false;
  Eigen::Map<Eigen::Vector3d>{residuals} = model_->residual(observation_, p_camera);
  if (jacobians == nullptr) return true;
  const Eigen::Matrix3d J_point = model_->point_jacobian(observation_, p_camera);
  if (jacobians[0] != nullptr) {
    Eigen::Map<Jacobian37> J(jacobians[0]);
    J.leftCols<6>() = J_point * twist_jacobian(p_camera);
    J.col(6).setZero();
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Jacobian33> J(jacobians[1]);
    J = J_point * T_camera_world.rotation_matrix();
  }
  return true;
}

}  // namespace tsg
