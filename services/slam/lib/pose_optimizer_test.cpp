#include "services/slam/lib/pose_optimizer.hpp"

#include <gtest/gtest.h>

#include <random>

#include "services/slam/lib/pnp.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

using synthetic::sighting;

const SE3 kTruth = synthetic::pose_at(0.1, -0.05, 0.2, 0.1);  // T_camera_world

std::vector<PointMatch> exact_matches(std::mt19937& generator, std::size_t count) {
  std::vector<PointMatch> matches;
  for (const Eigen::Vector3d& point : synthetic::random_points(generator, count)) {
    matches.push_back({point, sighting(kTruth, point)});
  }
  return matches;
}

/// Moves every third-or-so sighting anywhere in the image.
void spoil(std::mt19937& generator, double share, std::vector<PointMatch>& matches) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto spoiled = static_cast<std::size_t>(share * static_cast<double>(matches.size()));
  for (std::size_t i = 0; i < spoiled; ++i) {
    matches[i].observation.pixel = {640.0 * unit(generator), 480.0 * unit(generator)};
    matches[i].observation.inverse_depth = 0.2 + unit(generator);
  }
}

double error_of(const SE3& T_camera_world) {
  return (T_camera_world * kTruth.inverse()).log().norm();
}

const ObservationModel kModel(synthetic::camera(), SlamConfig{});

TEST(PoseOptimizer, FindsTheExactPoseFromExactSightings) {
  std::mt19937 generator(1);
  const auto matches = exact_matches(generator, 50);
  const PoseEstimate estimate = optimise_pose(kModel, matches, SE3());
  EXPECT_LT(error_of(estimate.T_camera_world), 1e-6);
  EXPECT_EQ(estimate.inliers, 50);
}

TEST(PoseOptimizer, WeighsWhatIsKnownOfThePoseAgainstTheSightings) {
  std::mt19937 generator(3);
  const auto matches = exact_matches(generator, 8);
  PosePrior prior{.T_camera_world = synthetic::pose_at(0.01, 0.0, 0.0) * kTruth};
  prior.information = 1e12 * Matrix6d::Identity();
  const PoseEstimate held = optimise_pose(kModel, matches, kTruth, prior);
  EXPECT_NEAR(error_of(held.T_camera_world), 0.01, 1e-4);
  prior.information = 1e-3 * Matrix6d::Identity();
  EXPECT_LT(error_of(optimise_pose(kModel, matches, kTruth, prior).T_camera_world), 1e-5);
}

TEST(PoseOptimizer, RecoversThePoseUnderThirtyPercentOutliers) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 generator(seed);
    auto matches = exact_matches(generator, 200);
    std::normal_distribution<double> noise(0.0, 0.5);
    for (PointMatch& match : matches) {
      match.observation.pixel += Eigen::Vector2d(noise(generator), noise(generator));
    }
    spoil(generator, 0.3, matches);
    const PoseEstimate estimate = optimise_pose(kModel, matches, SE3());
    EXPECT_LT(error_of(estimate.T_camera_world), 0.004);
    EXPECT_GE(estimate.inliers, 130);
    EXPECT_LE(estimate.inliers, 145);
  }
}

TEST(PoseOptimizer, CovarianceShrinksWithMoreSightings) {
  std::mt19937 generator(3);
  const auto few = exact_matches(generator, 20);
  const auto many = exact_matches(generator, 200);
  EXPECT_LT(optimise_pose(kModel, many, kTruth).covariance.trace(),
            0.3 * optimise_pose(kModel, few, kTruth).covariance.trace());
}

TEST(PoseOptimizer, WorksOnPixelsAlone) {
  std::mt19937 generator(4);
  auto matches = exact_matches(generator, 60);
  for (PointMatch& match : matches) match.observation.inverse_depth = 0.0;
  EXPECT_LT(error_of(optimise_pose(kModel, matches, SE3()).T_camera_world), 1e-5);
}

TEST(PoseOptimizer, LeavesThePoseWhereNothingIsMatched) {
  const PoseEstimate estimate = optimise_pose(kModel, {}, kTruth);
  EXPECT_EQ(estimate.inliers, 0);
  EXPECT_LT(error_of(estimate.T_camera_world), 1e-12);
}

TEST(SolvePnp, NeedsNoFirstGuessAndStandsHalfOfTheMatchesWrong) {
  std::mt19937 generator(5);
  auto matches = exact_matches(generator, 100);
  spoil(generator, 0.5, matches);
  const auto estimate = solve_pnp(kModel, matches, 20);
  ASSERT_TRUE(estimate);
  EXPECT_LT(error_of(estimate->T_camera_world), 1e-4);
}

TEST(SolvePnp, FindsNothingInRandomMatches) {
  std::mt19937 generator(6);
  auto matches = exact_matches(generator, 60);
  spoil(generator, 1.0, matches);
  EXPECT_FALSE(solve_pnp(kModel, matches, 20));
  EXPECT_FALSE(solve_pnp(kModel, {}, 20));
}

}  // namespace
}  // namespace tsg
