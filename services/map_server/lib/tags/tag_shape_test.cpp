#include "services/map_server/lib/tags/tag_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "services/map_server/lib/tags/tag_fixture.hpp"

namespace tsg {
namespace {

using test::surface_of;

constexpr double kVoxelM = 0.02;

/// A cloud turned about the vertical axis through the origin, then moved.
Cloud turned(Cloud cloud, float yaw_rad, const Eigen::Vector3f& by) {
  const Eigen::AngleAxisf R(yaw_rad, Eigen::Vector3f::UnitZ());
  for (CloudPoint& point : cloud) point.position = R * point.position + by;
  return cloud;
}

TEST(MeasureShape, FindsHowABoxIsTurned) {
  const Cloud table = surface_of({-0.8F, -0.4F, 0.0F}, {0.8F, 0.4F, 0.7F});
  for (const float degrees : {-75.0F, -30.0F, 0.0F, 20.0F, 45.0F, 88.0F}) {
    const float yaw_rad = degrees * static_cast<float>(M_PI / 180.0);
    const TagCells cells(kVoxelM, turned(table, yaw_rad, {2.0F, 1.0F, 0.0F}), {0, 0, 1.0F});
    const UprightBox box = measure_shape(cells).oriented_box;
    const float off = std::remainder(box.yaw_rad - yaw_rad, static_cast<float>(M_PI));
    EXPECT_LT(std::abs(off), 0.06F) << degrees;
    EXPECT_LE(std::abs(box.yaw_rad), static_cast<float>(M_PI_2) + 1e-4F);
    EXPECT_LT((box.size - Eigen::Vector3f(1.6F, 0.8F, 0.7F)).norm(), 0.08F) << degrees;
    EXPECT_LT((box.centre - Eigen::Vector3f(2.0F, 1.0F, 0.35F)).norm(), 0.02F) << degrees;
  }
}

TEST(MeasureShape, LiesAlongTheAxesOfTheMapWhereTurningSavesNothing) {
  Cloud ball;
  for (int i = 0; i < 4000; ++i) {  // spread evenly over a sphere
    const float z = -1.0F + (2.0F * static_cast<float>(i) + 1.0F) / 4000.0F;
    const float angle = 2.39996F * static_cast<float>(i);
    const float r = std::sqrt(1.0F - z * z);
    ball.push_back(
        {0.3F * Eigen::Vector3f(r * std::cos(angle), r * std::sin(angle), z), {}, 33, 1});
  }
  const TagShape shape = measure_shape(TagCells(kVoxelM, ball, {2.0F, 0, 0}));
  EXPECT_EQ(std::fmod(std::abs(shape.oriented_box.yaw_rad), static_cast<float>(M_PI_2)), 0.0F);
  EXPECT_NEAR(shape.oriented_box.size.x(), 0.6F, 0.03F);
}

TEST(MeasureShape, LeavesOutWhatIsSeenOnceInManyLooks) {
  TagCells cells(kVoxelM);
  const Cloud chair = surface_of({0, 0, 0}, {0.5F, 0.5F, 0.9F});
  for (int i = 0; i < 30; ++i) cells.join(TagCells(kVoxelM, chair, {-2.0F, 0, 1.0F}));
  cells.join(TagCells(kVoxelM, surface_of({0.5F, 0, 0}, {0.9F, 0.3F, 0.3F}), {-2.0F, 0, 1.0F}));
  EXPECT_NEAR(measure_shape(cells).box.sizes().x(), 0.5F, 0.03F);
  EXPECT_GT(rough_box(cells).sizes().x(), 0.8F);
}

TEST(MeasureShape, FindsAFarPosterAsThinAsItIs) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::normal_distribution<float> noise(0.0F, 0.002F * 4.5F * 4.5F);
  TagCells cells(kVoxelM);
  for (int keyframe = 0; keyframe < 20; ++keyframe) {
    Cloud seen = surface_of({4.5F, -0.4F, 0.7F}, {4.5F, 0.4F, 1.3F});
    for (CloudPoint& point : seen) point.position.x() += noise(random);
    cells.join(TagCells(kVoxelM, seen, {0, 0, 1.0F}));
  }
  const Eigen::AlignedBox3f box = measure_shape(cells).box;
  EXPECT_GT(rough_box(cells).sizes().x(), 0.16F);
  EXPECT_LT(box.sizes().x(), 0.08F);
  EXPECT_NEAR(box.center().x(), 4.5F, 0.02F);
  EXPECT_NEAR(box.sizes().y(), 0.8F, 0.04F);
  EXPECT_NEAR(box.sizes().z(), 0.6F, 0.04F);
}

TEST(RoughBox, IsEmptyWithoutCells) { EXPECT_TRUE(rough_box(TagCells(kVoxelM)).isEmpty()); }

}  // namespace
}  // namespace tsg
