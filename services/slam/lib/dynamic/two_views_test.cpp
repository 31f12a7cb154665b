#include "services/slam/lib/dynamic/two_views.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "services/slam/lib/dynamic/homography.hpp"
#include "services/slam/lib/dynamic/synthetic_pairs.hpp"

namespace tsg {
namespace {

constexpr double kThreshold = 1.0;
const SE3 kTurned = synthetic::pose_at(0.0, 0.0, 0.0, 0.04);

std::vector<PixelPair> seen(const synthetic::Body& body, const SE3& T_world_current) {
  auto pairs = synthetic::pairs_of(body, T_world_current);
  synthetic::add_noise(pairs, 0.3, 5);
  return pairs;
}

synthetic::Body wall_at(double depth_m, std::size_t count) {
  synthetic::Body wall = synthetic::room(count, 8);
  for (Eigen::Vector3d& point : wall.points) point *= depth_m / point.z();
  return wall;
}

std::size_t beyond_limit(const TwoViews& views, const std::vector<PixelPair>& pairs) {
  std::size_t count = 0;
  for (const PixelPair& pair : pairs) {
    if (views.distance(pair) > views.limit(kThreshold)) ++count;
  }
  return count;
}

TEST(FitHomography, TakesAPlaneFromOneImageToTheOther) {
  const SE3 T_world_current = synthetic::pose_at(0.2, 0.1, -0.1, 0.05);
  const auto four = synthetic::pairs_of(wall_at(2.0, kMinHomographyPairs), T_world_current);
  const auto H = fit_homography(four);
  ASSERT_TRUE(H);
  for (const PixelPair& pair : synthetic::pairs_of(wall_at(2.0, 50), T_world_current)) {
    EXPECT_LT(transfer_distance(*H, pair.p1, pair.p2), 1e-6);
    EXPECT_NEAR(transfer_distance(*H, pair.p1, pair.p2 + Eigen::Vector2d(3.0, 4.0)), 5.0, 1e-6);
  }
}

TEST(FitHomography, SaysNothingForThreePixelsOnALine) {
  std::vector<PixelPair> pairs{{{0.0, 0.0}, {1.0, 1.0}},
                               {{10.0, 10.0}, {11.0, 11.0}},
                               {{20.0, 20.0}, {21.0, 21.0}},
                               {{50.0, 0.0}, {51.0, 1.0}}};
  EXPECT_FALSE(fit_homography(pairs));
  EXPECT_FALSE(fit_homography(std::vector<PixelPair>(pairs.begin(), pairs.begin() + 3)));
}

TEST(EstimateTwoViews, FindsTheFundamentalMatrixWhereThereIsParallax) {
  const SE3 T_world_current = synthetic::pose_at(0.03, 0.02, 0.0, 0.01);
  const auto pairs = seen(synthetic::room(300, 1), T_world_current);
  const auto views = estimate_two_views(pairs, kThreshold);
  ASSERT_TRUE(views);
  EXPECT_TRUE(views->F);
  EXPECT_LT(beyond_limit(*views, pairs), 15U) << "5 % of what stands still";
}

TEST(EstimateTwoViews, ExpectsEverythingWhereItWasIfTheCameraStandsStill) {
  const auto pairs = seen(synthetic::room(300, 1), SE3());
  const auto views = estimate_two_views(pairs, kThreshold);
  ASSERT_TRUE(views);
  EXPECT_FALSE(views->F);
  EXPECT_LT(beyond_limit(*views, pairs), 15U);
  // Seen to move whatever way it goes: there is no line to hide on.
  for (const Eigen::Vector2d& way : {Eigen::Vector2d(3.0, 0.0), Eigen::Vector2d(0.0, 3.0)}) {
    EXPECT_GT(views->distance({{200.0, 100.0}, way + Eigen::Vector2d(200.0, 100.0)}), 2.5);
  }
}

TEST(EstimateTwoViews, NeedsNoLinesIfTheCameraOnlyTurns) {
  const synthetic::Body room = synthetic::room(300, 2);
  const auto views = estimate_two_views(seen(room, kTurned), kThreshold);
  ASSERT_TRUE(views);
  EXPECT_FALSE(views->F);
  EXPECT_LT(beyond_limit(*views, seen(room, kTurned)), 15U);
  synthetic::Body mover = synthetic::box_at({0.2, 0.0, 2.0}, 100, 3);
  mover.motion = {0.02, 0.0, 0.0};  // 5 pixels
  EXPECT_EQ(beyond_limit(*views, synthetic::pairs_of(mover, kTurned)), 100U);
}

TEST(EstimateTwoViews, TakesExactPairsOfAStandingCamera) {
  const auto pairs = synthetic::pairs_of(synthetic::room(100, 1), SE3());
  const auto views = estimate_two_views(pairs, kThreshold);
  ASSERT_TRUE(views);
  EXPECT_FALSE(views->F);
  EXPECT_EQ(beyond_limit(*views, pairs), 0U);
}

TEST(EstimateTwoViews, CannotTellAPlaneFromATurn) {
  const SE3 T_world_current = synthetic::pose_at(0.06, 0.0, 0.0);
  const auto views = estimate_two_views(seen(wall_at(3.0, 300), T_world_current), kThreshold);
  ASSERT_TRUE(views);
  EXPECT_FALSE(views->F);
  // The price: what stands still in front of a bare wall is taken for moving.
  const auto in_front =
      synthetic::pairs_of(synthetic::box_at({0.0, 0.0, 1.3}, 50, 4), T_world_current);
  EXPECT_EQ(beyond_limit(*views, in_front), 50U);
}

TEST(EstimateTwoViews, IsContentWithAThirdOfThePairsOffAPlane) {
  const SE3 T_world_current = synthetic::pose_at(0.06, 0.03, 0.0);
  auto pairs = seen(wall_at(3.0, 200), T_world_current);
  const auto off_plane = seen(synthetic::room(100, 6), T_world_current);
  pairs.insert(pairs.end(), off_plane.begin(), off_plane.end());
  const auto views = estimate_two_views(pairs, kThreshold);
  ASSERT_TRUE(views);
  EXPECT_TRUE(views->F);
  EXPECT_LT(beyond_limit(*views, pairs), 15U);
}

TEST(EstimateTwoViews, SaysNothingForFewPairsOrPixelsOnALine) {
  const auto pairs = synthetic::pairs_of(synthetic::room(7, 1), kTurned);
  EXPECT_FALSE(estimate_two_views(pairs, kThreshold));
  std::vector<PixelPair> line;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d pixel(10.0 * i, 100.0);
    line.push_back({pixel, pixel + Eigen::Vector2d(1.0, 0.0)});
  }
  EXPECT_FALSE(estimate_two_views(line, kThreshold));
}

}  // namespace
}  // namespace tsg
