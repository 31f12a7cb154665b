#include "services/slam/lib/pose_optimizer.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace tsg {
namespace {

constexpr int kPoseRounds = 4;
constexpr int kStepsPerRound = 6;      // per round; two or three suffice after the first
constexpr int kMinInliers = 3;         // below it 6 unknowns are not determined
constexpr double kPoseHuber = 1.5;     // standard deviations: quadratic below, linear above
constexpr double kConverged = 1e-7;    // metres and radians
constexpr double kNearestSeen = 0.05;  // metres; nothing nearer is seen
constexpr double kInitialDamping = 1e-6;
constexpr double kMaxDamping = 1e3;

double huber_weight(double norm) { return norm <= kPoseHuber ? 1.0 : kPoseHuber / norm; }
double huber_cost(double norm) {
  return norm <= kPoseHuber ? 0.5 * norm * norm : kPoseHuber * (norm - 0.5 * kPoseHuber);
}

struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double cost = 0.0;
};

/// Pixel and depth are judged apart: a corner at the rim of a thing often has the depth of what
/// lies behind it, and still the right place.
NormalEquations linearise(const ObservationModel& model,
                          const std::vector<PointMatch>& matches,
                          const std::vector<bool>& used,
                          const SE3& T_camera_world) {
  NormalEquations equations;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!used[i]) continue;
    const PointObservation& observation = matches[i].observation;
    const Eigen::Vector3d p_camera = T_camera_world * matches[i].p_world;
    if (p_camera.z() < kNearestSeen) continue;
    const Eigen::Vector3d residual = model.residual(observation, p_camera);
    const double pixel_norm = residual.head<2>().norm();
    const double depth_norm = std::abs(residual.z());
    equations.cost += huber_cost(pixel_norm) + huber_cost(depth_norm);
    const double pixel_weight = huber_weight(pixel_norm);
    const Eigen::Vector3d weights(pixel_weight, pixel_weight, huber_weight(depth_norm));
    const Jacobian36 J = chain_with_twist(model.point_jacobian(observation, p_camera), p_camera);
    const Eigen::Matrix<double, 6, 3> weighted = J.transpose() * weights.asDiagonal();
    equations.H.noalias() += weighted * J;
    equations.b.noalias() -= weighted * residual;
  }
  return equations;
}

double total_cost(const ObservationModel& model,
                  const std::vector<PointMatch>& matches,
                  const std::vector<bool>& used,
                  const SE3& T_camera_world) {
  double cost = 0.0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!used[i]) continue;
    const Eigen::Vector3d p_camera = T_camera_world * matches[i].p_world;
    if (p_camera.z() < kNearestSeen) continue;
    const Eigen::Vector3d residual = model.residual(matches[i].observation, p_camera);
    cost += huber_cost(residual.head<2>().norm()) + huber_cost(std::abs(residual.z()));
  }
  return cost;
}

/// The twist from the prior's pose to `T_camera_world`.
Vector6d deviation(const PosePrior& prior, const SE3& T_camera_world) {
  return (T_camera_world * prior.T_camera_world.inverse()).log();
}

double prior_cost(const PosePrior& prior, const SE3& T_camera_world) {
  const Vector6d moved = deviation(prior, T_camera_world);
  return 0.5 * moved.dot(prior.information * moved);
}

/// As the prior is near, a twist of the pose is one of the deviation.
void add_prior(const PosePrior& prior, const SE3& T_camera_world, NormalEquations& equations) {
  equations.H += prior.information;
  equations.b -= prior.information * deviation(prior, T_camera_world);
  equations.cost += prior_cost(prior, T_camera_world);
}

/// One round of Levenberg-Marquardt over the matches in `used`.
SE3 descend(const ObservationModel& model,
            const std::vector<PointMatch>& matches,
            const std::vector<bool>& used,
            const PosePrior& prior,
            SE3 T_camera_world) {
  double damping = kInitialDamping;
  NormalEquations equations = linearise(model, matches, used, T_camera_world);
  add_prior(prior, T_camera_world, equations);
  for (int i = 0; i < kStepsPerRound && damping < kMaxDamping; ++i) {
    Matrix6d damped = equations.H;
    damped.diagonal() *= 1.0 + damping;
    const Vector6d step = damped.ldlt().solve(equations.b);
    if (!step.allFinite()) break;
    const SE3 T_candidate_world = SE3::exp(step) * T_camera_world;
    const double cost =
        total_cost(model, matches, used, T_candidate_world) + prior_cost(prior, T_candidate_world);
    if (cost > equations.cost) {
      damping = damping < 1e-3 ? 1e-3 : damping * 10.0;
      continue;
    }
    T_camera_world = T_candidate_world;
    if (step.norm() < kConverged) break;
    damping *= 0.1;
    equations = linearise(model, matches, used, T_camera_world);
    add_prior(prior, T_camera_world, equations);
  }
  return T_camera_world;
}

/// Inliers of the pose; returns how many.
int classify(const ObservationModel& model,
             const std::vector<PointMatch>& matches,
             const SE3& T_camera_world,
             std::vector<bool>& is_inlier) {
  int inliers = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const PointObservation& observation = matches[i].observation;
    const Eigen::Vector3d p_camera = T_camera_world * matches[i].p_world;
    is_inlier[i] = p_camera.z() >= kNearestSeen &&
                   ObservationModel::is_inlier(model.residual(observation, p_camera));
    if (is_inlier[i]) ++inliers;
  }
  return inliers;
}

}  // namespace

PoseEstimate optimise_pose(const ObservationModel& model,
                           const std::vector<PointMatch>& matches,
                           const SE3& T_camera_world,
                           const PosePrior& prior) {
  PoseEstimate estimate{.T_camera_world = T_camera_world,
                        .is_inlier = std::vector<bool>(matches.size(), true),
                        .inliers = static_cast<int>(matches.size())};
  for (int round = 0; round < kPoseRounds && estimate.inliers >= kMinInliers; ++round) {
    const std::vector<bool> before = estimate.is_inlier;
    estimate.T_camera_world = descend(model, matches, before, prior, estimate.T_camera_world);
    estimate.inliers = classify(model, matches, estimate.T_camera_world, estimate.is_inlier);
    if (round > 0 && before == estimate.is_inlier) break;
  }
  if (estimate.inliers >= kMinInliers) {
    NormalEquations equations =
        linearise(model, matches, estimate.is_inlier, estimate.T_camera_world);
    add_prior(prior, estimate.T_camera_world, equations);
    estimate.covariance = equations.H.ldlt().solve(Matrix6d::Identity());
  }
  return estimate;
}

}  // namespace tsg
