#include "services/map_server/lib/voxel_grid.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>
#include <tuple>

namespace tsg {
namespace {

TEST(VoxelGrid, JoinsPointsOfACellToTheirMean) {
  VoxelGrid grid(0.1);
  grid.add({{0.01F, 0.02F, 0.03F}, {10, 20, 30}, 1, 1});
  grid.add({{0.05F, 0.06F, 0.07F}, {20, 40, 60}, 1, 3});
  ASSERT_EQ(grid.size(), 1U);
  const Voxel voxel = grid.voxel(0);
  EXPECT_EQ(voxel.cell, Eigen::Vector3i(0, 0, 0));
  EXPECT_TRUE(voxel.mean.position.isApprox(Eigen::Vector3f(0.04F, 0.05F, 0.06F), 1e-6F));
  EXPECT_EQ(voxel.mean.colour, (Rgb{18, 35, 53}));  // 17.5 and 52.5 round away from zero
  EXPECT_EQ(voxel.mean.weight, 4U);
}

TEST(VoxelGrid, KeepsPointsOfDifferentCellsApartAcrossZero) {
  VoxelGrid grid(0.05);
  grid.add({{-0.01F, 0.01F, 0.01F}, {}, 0, 1});
  grid.add({{0.01F, 0.01F, 0.01F}, {}, 0, 1});
  ASSERT_EQ(grid.size(), 2U);
  EXPECT_EQ(grid.voxel(0).cell, Eigen::Vector3i(-1, 0, 0));
  EXPECT_EQ(grid.voxel(1).cell, Eigen::Vector3i(0, 0, 0));
}

TEST(VoxelGrid, TakesTheClassOfTheMajorityByWeight) {
  VoxelGrid grid(1.0);
  const Eigen::Vector3f inside(0.5F, 0.5F, 0.5F);
  grid.add({inside, {}, 5, 2});
  grid.add({inside, {}, kBackgroundClass, 3});
  grid.add({inside, {}, 5, 2});
  EXPECT_EQ(grid.voxel(0).mean.class_id, 5);
}

TEST(VoxelGrid, LetsPointsWithoutAMaskAbstain) {
  VoxelGrid grid(1.0);
  const Eigen::Vector3f inside(0.5F, 0.5F, 0.5F);
  grid.add({inside, {}, kNotSegmentedClass, 100});
  EXPECT_EQ(grid.voxel(0).mean.class_id, kNotSegmentedClass);
  grid.add({inside, {}, 7, 1});
  EXPECT_EQ(grid.voxel(0).mean.class_id, 7);
}

TEST(VoxelGrid, IsEmptyAfterClear) {
  VoxelGrid grid(1.0);
  grid.add({{0.5F, 0.5F, 0.5F}, {}, 5, 2});
  grid.clear();
  EXPECT_EQ(grid.size(), 0U);
  grid.add({{0.5F, 0.5F, 0.5F}, {}, 6, 1});
  EXPECT_EQ(grid.voxel(0).mean.class_id, 6);
  EXPECT_EQ(grid.voxel(0).mean.weight, 1U);
}

TEST(VoxelGrid, ConservesCountsAndKeepsMeansInTheirCellsForAnyCloud) {
  constexpr unsigned kSeed = 20230;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> coordinate(-40.0F, 40.0F);
  std::uniform_int_distribution<int> byte(0, 255);
  VoxelGrid grid(0.7);
  std::set<std::tuple<int, int, int>> cells;
  constexpr int kPoints = 20000;
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3f p(coordinate(random), coordinate(random), coordinate(random));
    const auto channel = static_cast<std::uint8_t>(byte(random));
    grid.add({p, {channel, channel, channel}, static_cast<ClassId>(byte(random)), 1});
    const Eigen::Vector3d cell = (p.cast<double>() / 0.7).array().floor();
    cells.emplace(int(cell.x()), int(cell.y()), int(cell.z()));
  }
  EXPECT_EQ(grid.size(), cells.size());
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Voxel voxel = grid.voxel(i);
    total += voxel.mean.weight;
    const Eigen::Vector3f centre = 0.7F * (voxel.cell.cast<float>().array() + 0.5F);
    EXPECT_LE((voxel.mean.position - centre).cwiseAbs().maxCoeff(), 0.35F + 1e-4F);
  }
  EXPECT_EQ(total, std::uint64_t{kPoints});
}

}  // namespace
}  // namespace tsg
