#include "services/slam/lib/dynamic/fundamental_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "services/slam/lib/dynamic/synthetic_pairs.hpp"

namespace tsg {
namespace {

const SE3 kSecondView = synthetic::pose_at(0.15, -0.05, 0.1, 0.03);

/// From the poses themselves: F = K^-T [t]x R K^-1 (Hartley and Zisserman 2004, eq. 9.2).
Eigen::Matrix3d true_fundamental(const SE3& T_world_current) {
  const CameraModel model = synthetic::camera();
  Eigen::Matrix3d K;
  K << model.fx, 0.0, model.cx, 0.0, model.fy, model.cy, 0.0, 0.0, 1.0;
  const SE3 T_current_world = T_world_current.inverse();
  const Eigen::Vector3d& t = T_current_world.translation();
  Eigen::Matrix3d cross;
  cross << 0.0, -t.z(), t.y(), t.z(), 0.0, -t.x(), -t.y(), t.x(), 0.0;
  const Eigen::Matrix3d F =
      K.inverse().transpose() * cross * T_current_world.rotation_matrix() * K.inverse();
  return F.normalized();
}

double largest_distance(const Eigen::Matrix3d& F, const std::vector<PixelPair>& pairs) {
  double largest = 0.0;
  for (const PixelPair& pair : pairs) {
    largest = std::max(largest, epipolar_distance(F, pair.p1, pair.p2));
  }
  return largest;
}

double rms_distance(const Eigen::Matrix3d& F, const std::vector<PixelPair>& pairs) {
  double sum = 0.0;
  for (const PixelPair& pair : pairs) {
    sum += std::pow(epipolar_distance(F, pair.p1, pair.p2), 2);
  }
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

TEST(EpipolarDistance, IsThatOfThePointFromTheLineInPixels) {
  // A camera that moves along x: lines are rows.
  const Eigen::Matrix3d F = true_fundamental(synthetic::pose_at(0.1, 0.0, 0.0));
  EXPECT_NEAR(epipolar_distance(F, {100.0, 200.0}, {80.0, 200.0}), 0.0, 1e-9);
  EXPECT_NEAR(epipolar_distance(F, {100.0, 200.0}, {80.0, 203.5}), 3.5, 1e-9);
  EXPECT_NEAR(epipolar_distance(-5.0 * F, {100.0, 200.0}, {640.0, 198.0}), 2.0, 1e-9);
}

TEST(EpipolarDistance, IsInfiniteAtTheEpipoleThatHasNoLine) {
  // A camera that moves straight on: the epipole is the principal point.
  const CameraModel model = synthetic::camera();
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
  F << 0.0, -1.0, model.cy, 1.0, 0.0, -model.cx, -model.cy, model.cx, 0.0;
  EXPECT_TRUE(std::isinf(epipolar_distance(F, {model.cx, model.cy}, {100.0, 100.0})));
  EXPECT_NEAR(epipolar_distance(F, {400.0, model.cy}, {420.0, model.cy + 2.0}), 2.0, 1e-9);
}

TEST(EightPoint, RecoversTheMatrixOfTwoCamerasFromEightPairs) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto few = synthetic::pairs_of(synthetic::room(kMinFundamentalPairs, seed), kSecondView);
    const auto F = eight_point(few);
    ASSERT_TRUE(F);
    const auto others = synthetic::pairs_of(synthetic::room(200, seed + 100), kSecondView);
    EXPECT_LT(largest_distance(*F, others), 1e-6);
    const Eigen::Matrix3d truth = true_fundamental(kSecondView);
    EXPECT_LT(std::min((*F - truth).norm(), (*F + truth).norm()), 1e-8);
  }
}

TEST(EightPoint, StaysBelowThePixelWithNoiseAndHasRankTwo) {
  auto pairs = synthetic::pairs_of(synthetic::room(300, 1), kSecondView);
  const auto exact = pairs;
  synthetic::add_noise(pairs, 0.5, 2);
  const auto F = eight_point(pairs);
  ASSERT_TRUE(F);
  EXPECT_LT(rms_distance(*F, exact), 0.3);
  EXPECT_NEAR(F->norm(), 1.0, 1e-12);
  EXPECT_NEAR(F->determinant(), 0.0, 1e-18);
}

TEST(EightPoint, SaysNothingWhereThePairsLeaveMoreThanOneSolution) {
  const synthetic::Body room = synthetic::room(100, 1);
  const auto exact = synthetic::pairs_of(room, kSecondView);
  EXPECT_FALSE(eight_point(std::vector<PixelPair>(exact.begin(), exact.begin() + 7)));
  EXPECT_FALSE(eight_point(std::vector<PixelPair>(20, exact.front()))) << "one pixel";
  EXPECT_FALSE(eight_point(synthetic::pairs_of(room, SE3()))) << "the camera stands still";
  EXPECT_FALSE(eight_point(synthetic::pairs_of(room, synthetic::pose_at(0.0, 0.0, 0.0, 0.05))))
      << "it only turns";
  synthetic::Body wall = room;
  for (Eigen::Vector3d& point : wall.points) point *= 3.0 / point.z();
  EXPECT_FALSE(eight_point(synthetic::pairs_of(wall, kSecondView))) << "all lie on one plane";
}

TEST(EstimateFundamental, IsNotMisledByFortyPercentOfWrongPairs) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    auto pairs = synthetic::pairs_of(synthetic::room(400, seed), kSecondView);
    synthetic::add_noise(pairs, 0.3, seed);
    const std::vector<PixelPair> right(pairs.begin() + 160, pairs.end());
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> anywhere(-25.0, 25.0);
    for (std::size_t i = 0; i < 160; ++i) {
      pairs[i].p2 += Eigen::Vector2d(anywhere(generator), anywhere(generator));
    }
    const auto found = estimate_fundamental(pairs, {});
    ASSERT_TRUE(found);
    EXPECT_LT(rms_distance(found->model, right), 0.6);  // 0.42 of it is the noise
    const auto agreeing = std::count(found->agrees.begin() + 160, found->agrees.end(), true);
    EXPECT_GT(agreeing, 220) << "of 240 right pairs";
    EXPECT_EQ(found->count, std::count(found->agrees.begin(), found->agrees.end(), true));
  }
}

TEST(EstimateFundamental, AnswersTheSameEachTime) {
  auto pairs = synthetic::pairs_of(synthetic::room(200, 3), kSecondView);
  synthetic::add_noise(pairs, 0.5, 3);
  const auto once = estimate_fundamental(pairs, {});
  const auto again = estimate_fundamental(pairs, {});
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->model, again->model);
  EXPECT_EQ(once->agrees, again->agrees);
}

TEST(EstimateFundamental, SaysNothingWithoutEightPairsOrWithoutParallax) {
  const synthetic::Body room = synthetic::room(50, 1);
  const auto exact = synthetic::pairs_of(room, kSecondView);
  EXPECT_FALSE(estimate_fundamental({}, {}));
  EXPECT_FALSE(estimate_fundamental(std::vector<PixelPair>(exact.begin(), exact.begin() + 7), {}));
  EXPECT_FALSE(estimate_fundamental(synthetic::pairs_of(room, SE3()), {}));
}

}  // namespace
}  // namespace tsg
