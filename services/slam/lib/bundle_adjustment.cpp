#include "services/slam/lib/bundle_adjustment.hpp"

#include <ceres/ceres.h>

#include <cmath>
#include <memory>

#include "services/slam/lib/reprojection_cost.hpp"
#include "services/slam/lib/solver_stop.hpp"

namespace tsg {
namespace {

constexpr double kBundleHuber = 2.5;       // standard deviations in three dimensions
constexpr std::size_t kManyCameras = 100;  // from here on most pairs see nothing in common
constexpr double kBundleTolerance = 1e-4;  // relative; further down is below the noise

ceres::Solver::Options make_options(const BundleLimits& limits, std::size_t cameras) {
  ceres::Solver::Options options;
  options.linear_solver_type = cameras < kManyCameras ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  options.num_threads = 1;  // more would sum in another order from run to run
  options.max_num_iterations = limits.max_iterations;
  options.function_tolerance = kBundleTolerance;
  options.logging_type = ceres::SILENT;
  if (limits.time_budget_s > 0.0) options.max_solver_time_in_seconds = limits.time_budget_s;
  return options;
}

/// Hands the blocks to Ceres; points are eliminated first.
void build(const ObservationModel& model,
           BundleProblem& problem,
           std::vector<PoseBlock>& poses,
           ceres::Problem& solver_problem,
           ceres::ParameterBlockOrdering& ordering) {
  auto* manifold = new LeftTwistManifold;           // owned by solver_problem
  auto* loss = new ceres::HuberLoss(kBundleHuber);  // owned by solver_problem
  poses.reserve(problem.cameras.size());
  for (const BundleProblem::Camera& camera : problem.cameras) {
    poses.push_back(to_pose_block(camera.T_camera_world));
    solver_problem.AddParameterBlock(poses.back().data(), 7, manifold);
    if (camera.fixed) solver_problem.SetParameterBlockConstant(poses.back().data());
    ordering.AddElementToGroup(poses.back().data(), 1);
  }
  for (Eigen::Vector3d& point : problem.points) {
    solver_problem.AddParameterBlock(point.data(), 3);
    ordering.AddElementToGroup(point.data(), 0);
  }
  for (const BundleProblem::Sighting& sighting : problem.sightings) {
    solver_problem.AddResidualBlock(new ReprojectionCost(model, sighting.observation), loss,
                                    poses[sighting.camera].data(),
                                    problem.points[sighting.point].data());
  }
}

}  // namespace

BundleSummary adjust_bundle(const ObservationModel& model,
                            const BundleLimits& limits,
                            BundleProblem& problem) {
  if (problem.sightings.empty()) return {};
  std::vector<PoseBlock> poses;
  ceres::Problem solver_problem;
  ceres::Solver::Options options = make_options(limits, problem.cameras.size());
  options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  build(model, problem, poses, solver_problem, *options.linear_solver_ordering);
  SolverStop stop(limits.must_stop);
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &solver_problem, &summary);
  if (!summary.IsSolutionUsable()) return {};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!problem.cameras[i].fixed) problem.cameras[i].T_camera_world = to_se3(poses[i].data());
  }
  return {summary.initial_cost, summary.final_cost, static_cast<int>(summary.iterations.size()) - 1,
          true};
}

}  // namespace tsg
