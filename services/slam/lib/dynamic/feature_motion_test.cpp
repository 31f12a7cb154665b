#include "services/slam/lib/dynamic/feature_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "services/slam/lib/feature_extractor.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

constexpr std::size_t kBoard = 1;  // of the scene's panels
constexpr float kBoardInverseDepth = 0.5F;

bool is_on_board(const Feature& feature) {
  return std::abs(feature.inverse_depth - kBoardInverseDepth) < 0.02F;
}

/// Five by five features on one surface, ten pixels apart.
Features patch_of_features() {
  Features features;
  for (int i = 0; i < 25; ++i) {
    const int row = i / 5;
    const int column = i % 5;
    const Eigen::Vector2f pixel(300.0F + 10.0F * static_cast<float>(column),
                                200.0F + 10.0F * static_cast<float>(row));
    features.items.push_back({.pixel = pixel, .inverse_depth = 0.5F});
  }
  features.descriptors.resize(features.size());
  features.grid = FeatureGrid(features.items, 640, 480);
  return features;
}

class FeatureMotionTest : public testing::Test {
 protected:
  Features extract(std::uint64_t seq, const SE3& T_world_camera) {
    return extractor_.extract(scene_.render(seq, T_world_camera), {});
  }

  SlamConfig config_;
  ObservationModel model_{synthetic::camera(), config_};
  FeatureExtractor extractor_{config_.features, synthetic::camera()};
  /// A wall, and a board so large that its texture is not squeezed into noise.
  synthetic::Scene scene_{
      {{.z = 3.0, .corner = {-4.0, -3.0}, .extent = {8.0, 6.0}, .texture_seed = 1},
       {.z = 2.0, .corner = {0.1, -3.0}, .extent = {6.0, 6.0}, .texture_seed = 2}}};
};

TEST_F(FeatureMotionTest, StaticFeaturesAreStillUnderAMovedCamera) {
  const SE3 T_world_now = synthetic::pose_at(0.08, 0.02, 0.05, 0.03);
  const Features then = extract(0, SE3());
  const Features now = extract(9, T_world_now);
  const auto motion = compare_features(model_, {now, T_world_now}, {then, SE3()});
  ASSERT_EQ(motion.size(), now.size());
  const auto still = std::ranges::count(motion, Motion::kStill, &FeatureMotion::motion);
  const auto moved = std::ranges::count(motion, Motion::kMoved, &FeatureMotion::motion);
  EXPECT_GT(still, 400);
  // Squares look much alike: some are taken for others, but these do not go the same way.
  EXPECT_LT(moved, 0.2 * static_cast<double>(still));
  EXPECT_LE(std::ranges::count(moving_in_company(now, motion), true), 5);
}

TEST_F(FeatureMotionTest, ThoseOfAMovedBoardMoveInCompany) {
  const Features then = extract(0, SE3());
  scene_.panel(kBoard).corner += Eigen::Vector2d(0.07, 0.02);  // 19 pixels
  const Features now = extract(6, SE3());
  const auto motion = compare_features(model_, {now, SE3()}, {then, SE3()});
  const auto moving = moving_in_company(now, motion);
  int on_board = 0;
  int still = 0;
  int moved = 0;
  int in_company = 0;
  int elsewhere = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (is_on_board(now.items[i])) {
      ++on_board;
      moved += motion[i].motion == Motion::kMoved ? 1 : 0;
      still += motion[i].motion == Motion::kStill ? 1 : 0;
      in_company += moving[i] ? 1 : 0;
    } else {
      elsewhere += moving[i] ? 1 : 0;
    }
  }
  ASSERT_GT(on_board, 50);
  EXPECT_GT(moved, 0.4 * on_board);  // many are not found again
  EXPECT_LT(still, 0.1 * moved);
  EXPECT_GT(in_company, 0.8 * on_board);
  EXPECT_LT(elsewhere, 0.02 * static_cast<double>(now.size()));
}

TEST(MovingInCompany, OneWrongMatchStandsAlone) {
  const Features features = patch_of_features();
  std::vector<FeatureMotion> motion(features.size(), {.motion = Motion::kStill});
  motion[12] = {.motion = Motion::kMoved, .shift = {20.0F, 0.0F, 0.0F}};
  EXPECT_EQ(std::ranges::count(moving_in_company(features, motion), true), 0);
}

TEST(MovingInCompany, WrongMatchesGoTheirOwnWays) {
  const Features features = patch_of_features();
  std::vector<FeatureMotion> motion(features.size(), {.motion = Motion::kMoved});
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const auto turn = static_cast<float>(i) * 6.2832F / 25.0F;
    motion[i].shift = {30.0F * std::cos(turn), 30.0F * std::sin(turn), i % 2 == 0 ? 25.0F : -25.0F};
  }
  EXPECT_EQ(std::ranges::count(moving_in_company(features, motion), true), 0);
}

TEST(MovingInCompany, TakesTheUntestedAlong) {
  const Features features = patch_of_features();
  std::vector<FeatureMotion> motion(features.size(),
                                    {.motion = Motion::kMoved, .shift = {20.0F, 0.0F, 0.0F}});
  motion[12] = {};
  motion[24] = {.motion = Motion::kStill};
  const auto moving = moving_in_company(features, motion);
  EXPECT_TRUE(moving[12]);
  EXPECT_FALSE(moving[24]);
  EXPECT_EQ(std::ranges::count(moving, true), 24);
}

}  // namespace
}  // namespace tsg
