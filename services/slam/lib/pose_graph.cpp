#include "services/slam/lib/pose_graph.hpp"

#include <ceres/ceres.h>

#include "services/slam/lib/reprojection_cost.hpp"
#include "services/slam/lib/solver_stop.hpp"

namespace tsg {
namespace {

constexpr int kMaxIterations = 50;
constexpr double kGraphTolerance = 1e-6;  // relative

/// What an edge misses by: log(T_a_b^-1 * T_a_world * T_world_b), weighted.
class EdgeCost final : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit EdgeCost(const PoseGraph::Edge& edge) : T_b_a_(edge.T_a_b.inverse()) {
    weights_ << Eigen::Vector3d::Constant(edge.translation_weight),
        Eigen::Vector3d::Constant(edge.rotation_weight);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const SE3 T_a_world = to_se3(parameters[0]);
    const SE3 T_b_world = to_se3(parameters[1]);
    const Vector6d error = (T_b_a_ * T_a_world * T_b_world.inverse()).log();
    Eigen::Map<Vector6d>{residuals} = weights_.cwiseProduct(error);
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr)
      write(inverse_left_jacobian(error) * adjoint(T_b_a_), jacobians[0]);
    // A step from the right of E is one from the left of E^-1.
    if (jacobians[1] != nullptr) write(-inverse_left_jacobian(-error), jacobians[1]);
    return true;
  }

 private:
  /// As LeftTwistManifold wants it: by the twist, in the first six columns.
  void write(const Matrix66& by_twist, double* jacobian) const {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
    J.leftCols<6>() = weights_.asDiagonal() * by_twist;
    J.col(6).setZero();
  }

  SE3 T_b_a_;
  Vector6d weights_;
};

/// The matrix with ad(a) * b = the Lie bracket of the twists.
Matrix66 bracket(const Vector6d& twist) {
  Matrix66 ad = Matrix66::Zero();
  ad.topLeftCorner<3, 3>() = skew(twist.tail<3>());
  ad.topRightCorner<3, 3>() = skew(twist.head<3>());
  ad.bottomRightCorner<3, 3>() = skew(twist.tail<3>());
  return ad;
}

}  // namespace

Matrix66 adjoint(const SE3& T_a_b) {
  const Eigen::Matrix3d R_a_b = T_a_b.rotation_matrix();
  Matrix66 matrix = Matrix66::Zero();
  matrix.topLeftCorner<3, 3>() = R_a_b;
  matrix.topRightCorner<3, 3>() = skew(T_a_b.translation()) * R_a_b;
  matrix.bottomRightCorner<3, 3>() = R_a_b;
  return matrix;
}

Matrix66 inverse_left_jacobian(const Vector6d& twist) {
  const Matrix66 ad = bracket(twist);
  const Matrix66 ad2 = ad * ad;
  const Matrix66 ad4 = ad2 * ad2;
  return Matrix66::Identity() - ad / 2.0 + ad2 / 12.0 - ad4 / 720.0 + ad4 * ad2 / 30240.0 -
         ad4 * ad4 / 1209600.0;
}

bool relax(PoseGraph& graph, const std::function<bool()>& must_stop) {
  if (graph.edges.empty()) return false;
  LeftTwistManifold manifold;
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  std::vector<PoseBlock> poses;
  poses.reserve(graph.nodes.size());
  for (const PoseGraph::Node& node : graph.nodes) {
    poses.push_back(to_pose_block(node.T_world_camera.inverse()));
    problem.AddParameterBlock(poses.back().data(), 7, &manifold);
    if (node.fixed) problem.SetParameterBlockConstant(poses.back().data());
  }
  for (const PoseGraph::Edge& edge : graph.edges) {
    problem.AddResidualBlock(new EdgeCost(edge), nullptr, poses[edge.a].data(),
                             poses[edge.b].data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.num_threads = 1;  // more would sum in another order from run to run
  options.max_num_iterations = kMaxIterations;
  options.function_tolerance = kGraphTolerance;
  options.logging_type = ceres::SILENT;
  SolverStop stop(must_stop);
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable() || stop.has_stopped()) return false;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!graph.nodes[i].fixed) graph.nodes[i].T_world_camera = to_se3(poses[i].data()).inverse();
  }
  return true;
}

}  // namespace tsg
