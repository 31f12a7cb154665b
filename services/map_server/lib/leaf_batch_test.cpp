#include "services/map_server/lib/leaf_batch.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <set>
#include <tuple>

namespace tsg {
namespace {

using Cell = std::tuple<int, int, int>;

struct SeenCells {
  std::set<Cell> free;
  std::set<Cell> occupied;
};

SeenCells cells_of(const LeafBatch& batch) {
  SeenCells cells;
  for (const LeafBatch::Block& block : batch.blocks()) {
    std::size_t next_hit = 0;
    for (unsigned morton = 0; morton < 512; ++morton) {
      if (!block.seen.contains(morton)) continue;
      Eigen::Vector3i cell = block.first_cell;
      for (unsigned bit = 0; bit < 9; ++bit) cell[bit % 3] += int(morton >> bit & 1U) << (bit / 3);
      const bool is_hit = next_hit < block.hits.size() && block.hits[next_hit].morton == morton;
      next_hit += is_hit ? 1 : 0;
      (is_hit ? cells.occupied : cells.free).emplace(cell.x(), cell.y(), cell.z());
    }
    EXPECT_EQ(next_hit, block.hits.size());
  }
  return cells;
}

VoxelGrid grid_with(const std::vector<Eigen::Vector3f>& points, double leaf_m) {
  VoxelGrid grid(leaf_m);
  for (const Eigen::Vector3f& point : points) grid.add({point, {}, 0, 1});
  return grid;
}

TEST(LeafBatch, FreesTheCellsUpToTheEndAndNotTheEnd) {
  const VoxelGrid leaves = grid_with({{0.55F, 0.05F, 0.05F}}, 0.1);
  const SeenCells cells = cells_of(LeafBatch(leaves, {}, {0.05, 0.05, 0.05}, 0.1));
  EXPECT_EQ(cells.occupied, (std::set<Cell>{{5, 0, 0}}));
  EXPECT_EQ(cells.free, (std::set<Cell>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
}

TEST(LeafBatch, WalksBackwardsAcrossTheOrigin) {
  const VoxelGrid leaves = grid_with({{-0.15F, 0.05F, 0.05F}}, 0.1);
  const SeenCells cells = cells_of(LeafBatch(leaves, {}, {0.15, 0.05, 0.05}, 0.1));
  EXPECT_EQ(cells.occupied, (std::set<Cell>{{-2, 0, 0}}));
  EXPECT_EQ(cells.free, (std::set<Cell>{{1, 0, 0}, {0, 0, 0}, {-1, 0, 0}}));
}

TEST(LeafBatch, KeepsAnOccupiedLeafThatAnotherRayCrosses) {
  const VoxelGrid leaves = grid_with({{0.25F, 0.05F, 0.05F}, {0.95F, 0.05F, 0.05F}}, 0.1);
  const SeenCells cells = cells_of(LeafBatch(leaves, {}, {0.05, 0.05, 0.05}, 0.1));
  EXPECT_EQ(cells.occupied, (std::set<Cell>{{2, 0, 0}, {9, 0, 0}}));
  EXPECT_EQ(cells.free.count({2, 0, 0}), 0U);
}

TEST(LeafBatch, FreesTheWayToAFreeEnd) {
  const SeenCells cells =
      cells_of(LeafBatch(VoxelGrid(0.1), {{0.05F, 0.35F, 0.05F}}, {0.05, 0.05, 0.05}, 0.1));
  EXPECT_TRUE(cells.occupied.empty());
  EXPECT_EQ(cells.free, (std::set<Cell>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}));
}

TEST(LeafBatch, WalksFromCellToNeighbouringCellForAnyRay) {
  constexpr unsigned kSeed = 99;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> coordinate(-3.0F, 3.0F);
  const auto any_point = [&] {
    return Eigen::Vector3f(coordinate(random), coordinate(random), coordinate(random));
  };
  for (int round = 0; round < 300; ++round) {
    const Eigen::Vector3d origin = any_point().cast<double>();
    const Eigen::Vector3f end = any_point();
    const VoxelGrid leaves = grid_with({end}, 0.05);
    const SeenCells cells = cells_of(LeafBatch(leaves, {}, origin, 0.05));
    const Eigen::Vector3i first = (origin / 0.05).array().floor().cast<int>();
    // A walk over faces takes as many steps as the cells are apart, and visits none twice.
    const auto steps = (leaves.voxel(0).cell - first).cwiseAbs().sum();
    EXPECT_EQ(cells.free.size(), std::size_t(steps));
    for (const auto& [x, y, z] : cells.free) {
      // Every cell lies on the ray: its centre is at most half a diagonal away.
      const Eigen::Vector3d centre = 0.05 * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
      const Eigen::Vector3d along = (end.cast<double>() - origin).normalized();
      EXPECT_LE((centre - origin).cross(along).norm(), 0.05 * 0.8661);
    }
  }
}

}  // namespace
}  // namespace tsg
