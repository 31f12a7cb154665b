#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "services/map_server/lib/cloud.hpp"

namespace tsg {

/// The class that most of a set of points have: exact where one class has more than half of the
/// weight (Boyer-Moore majority vote). Points without a mask do not vote.
class ClassVote {
 public:
  void add(ClassId id, std::uint32_t weight);
  /// kNotSegmentedClass where nobody voted.
  [[nodiscard]] ClassId winner() const { return winner_; }

 private:
  ClassId winner_ = kNotSegmentedClass;
  std::uint32_t lead_ = 0;
};

/// A cell of a grid that starts at the origin: [cell, cell + 1) * voxel size along each axis.
struct Voxel {
  Eigen::Vector3i cell;
  CloudPoint mean;  ///< position and colour; the majority's class; weight = all points' together
};

/// Joins points by cells (the paper's voxel filter): a hash table of running means, so adding is
/// cheap however large the cloud. Coordinates must lie within +-2^20 voxels. One owner.
class VoxelGrid {
 public:
  explicit VoxelGrid(double voxel_m);

  void add(const CloudPoint& point);
  /// Keeps the memory.
  void clear();
  /// Number of cells with a point.
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// In the order in which the cells got their first point, so results are reproducible.
  [[nodiscard]] Voxel voxel(std::size_t index) const;
  /// The index of the cell of a point that has been added.
  [[nodiscard]] std::size_t index_of(const Eigen::Vector3f& position) const;
  [[nodiscard]] Cloud to_cloud() const;

 private:
  struct Cell {
    std::uint64_t key = 0;
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    Eigen::Vector3f colour = Eigen::Vector3f::Zero();
    std::uint32_t weight = 0;
    ClassVote vote;
  };

  [[nodiscard]] std::uint64_t key_of(const Eigen::Vector3f& position) const;
  Cell& cell_with(std::uint64_t key);
  /// Where the cell is noted, or would be.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const;
  void grow();

  double cells_per_metre_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> slots_;  // index into cells_ plus 1, 0 = free; size is a power of two
  std::size_t last_ = 0;              // neighbouring points mostly share a cell
};

/// One point for each voxel of the cloud's own frame. What `grid` held is lost; to hand in the same
/// one each time saves getting its megabytes from the system anew.
[[nodiscard]] Cloud voxel_filter(const Cloud& cloud, VoxelGrid& grid);

}  // namespace tsg
