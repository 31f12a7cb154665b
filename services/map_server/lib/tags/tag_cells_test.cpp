#include "services/map_server/lib/tags/tag_cells.hpp"

#include <gtest/gtest.h>

#include "services/map_server/lib/tags/tag_fixture.hpp"

namespace tsg {
namespace {

constexpr double kTagVoxelM = 0.02;
const Eigen::Vector3f kCamera = Eigen::Vector3f::Zero();

CloudPoint tag_point_at(const Eigen::Vector3f& position, std::uint32_t weight = 1) {
  return {position, {10, 20, 30}, 57, weight};
}

TEST(TagCells, JoinPointsOfOneVoxelByWeight) {
  const TagCells cells(
      kTagVoxelM, {tag_point_at({1.001F, 0.01F, -0.01F}, 3), tag_point_at({1.009F, 0.01F, -0.01F})},
      kCamera);
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_NEAR(cells.cells()[0].position.x(), 1.003F, 1e-5F);
  EXPECT_EQ(cells.cells()[0].weight, 4U);
  EXPECT_EQ(cells.cells()[0].keyframes, 1U);
}

TEST(TagCells, KnowHowDepthErrsAlongTheRay) {
  const TagCells cells(kTagVoxelM, {tag_point_at({0.0F, 3.0F, 4.0F})}, kCamera);
  EXPECT_NEAR(cells.cells()[0].depth_noise.norm(), 0.002F * 25.0F, 1e-5F);
  EXPECT_NEAR(cells.cells()[0].depth_noise.y() / cells.cells()[0].depth_noise.z(), 0.75F, 1e-5F);
}

TEST(TagCells, CountKeyframesThatShowAVoxel) {
  TagCells cells(kTagVoxelM);
  for (int i = 0; i < 3; ++i)
    cells.join(TagCells(kTagVoxelM, {tag_point_at({1.0F, 0.0F, 0.0F})}, kCamera));
  cells.join(TagCells(kTagVoxelM, {tag_point_at({0.5F, 0.0F, 0.0F})}, kCamera));
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(cells.at({1.0F, 0.0F, 0.0F})->keyframes, 3U);
  EXPECT_EQ(cells.at({0.5F, 0.0F, 0.0F})->keyframes, 1U);
  EXPECT_EQ(cells.at({0.7F, 0.0F, 0.0F}), nullptr);
}

TEST(TagCells, JoinTheSameInAnyOrder) {
  const TagCells a(kTagVoxelM, test::surface_of({0, 0, 0}, {0.3F, 0.2F, 0.1F}), kCamera);
  const TagCells b(kTagVoxelM, test::surface_of({0.1F, 0, -0.1F}, {0.4F, 0.2F, 0.1F}), kCamera);
  TagCells ab = a;
  ab.join(b);
  TagCells ba = b;
  ba.join(a);
  ASSERT_EQ(ab.size(), ba.size());
  for (std::size_t i = 0; i < ab.size(); ++i) {
    EXPECT_EQ(ab.cells()[i].key, ba.cells()[i].key);
    EXPECT_LT((ab.cells()[i].position - ba.cells()[i].position).norm(), 1e-5F);
  }
}

TEST(TagCells, OfTwoSizesBecomeTheCoarserOnes) {
  TagCells coarse(kTagVoxelM, test::surface_of({-0.2F, -0.2F, -0.2F}, {0.2F, 0.2F, 0.2F}), kCamera);
  const TagCells fine = coarse;
  coarse.coarsen();
  EXPECT_LT(coarse.size(), fine.size() / 3);
  for (const TagCell& cell : coarse.cells()) EXPECT_NE(coarse.at(cell.position), nullptr);
  TagCells joined = fine;
  joined.join(coarse);
  EXPECT_EQ(joined.size(), coarse.size());
  joined = coarse;
  joined.join(fine);
  EXPECT_EQ(joined.size(), coarse.size());
  EXPECT_DOUBLE_EQ(joined.voxel_m(), 2 * kTagVoxelM);
}

TEST(TagCells, AreNearWhatIsInTheNextVoxel) {
  const TagCells cells(kTagVoxelM, {tag_point_at({-0.01F, 0.01F, 0.01F})}, kCamera);
  EXPECT_TRUE(cells.is_near({-0.015F, 0.01F, 0.01F}));
  EXPECT_TRUE(cells.is_near({0.015F, 0.01F, 0.01F}));
  EXPECT_TRUE(cells.is_near({-0.01F, 0.01F, -0.015F}));
  EXPECT_FALSE(cells.is_near({0.03F, 0.01F, 0.01F}));
}

TEST(TagCells, TellTheShareOfAPartInTheWhole) {
  const TagCells whole(kTagVoxelM, test::surface_of({0, 0, 0}, {1.0F, 0.5F, 0.01F}), kCamera);
  const TagCells half(kTagVoxelM, test::surface_of({0.5F, 0, 0}, {1.5F, 0.5F, 0.01F}), kCamera);
  EXPECT_NEAR(share_within(half, whole, 400), 0.5, 0.06);
  EXPECT_EQ(share_within(whole, whole, 100), 1.0);
  EXPECT_EQ(share_within(whole, TagCells(kTagVoxelM), 100), 0.0);
  EXPECT_EQ(share_within(TagCells(kTagVoxelM), whole, 100), 0.0);
}

TEST(TagCells, GiveTheCloudWithColoursAndWeights) {
  const TagCells cells(kTagVoxelM, {tag_point_at({1.0F, 2.0F, 3.0F}, 5)}, kCamera);
  const Cloud cloud = cells.to_cloud(63);
  ASSERT_EQ(cloud.size(), 1U);
  EXPECT_EQ(cloud[0].colour, (Rgb{10, 20, 30}));
  EXPECT_EQ(cloud[0].class_id, 63);
  EXPECT_EQ(cloud[0].weight, 5U);
}

}  // namespace
}  // namespace tsg
