#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "services/map_server/lib/voxel_grid.hpp"

namespace tsg {

/// The leaf cells of an octree that one keyframe has seen occupied or free, gathered before the
/// tree is touched: each leaf once, however many rays cross it, and in the tree's own order.
class LeafBatch {
 public:
  static constexpr unsigned kBlockLevel = 3;           ///< a block has (2^3)^3 leaves
  static constexpr int kBlockEdge = 1 << kBlockLevel;  ///< leaves along each axis

  /// A set of leaves of one block, in Morton order (x lowest): 64-bit words are cubes of 4 leaves a
  /// side, bytes cubes of 2, i.e. the subtrees below the block's node.
  class LeafSet {
   public:
    void insert(unsigned morton) { words_[morton / 64] |= std::uint64_t{1} << (morton % 64); }
    [[nodiscard]] bool contains(unsigned morton) const {
      return (words_[morton / 64] >> (morton % 64) & 1U) != 0;
    }
    /// True where the `index`-th subtree of 8^level leaves has a leaf of the set.
    [[nodiscard]] bool intersects(unsigned level, unsigned index) const;

   private:
    std::array<std::uint64_t, 8> words_{};
  };

  struct Hit {
    unsigned morton;      ///< within its block
    std::uint32_t index;  ///< of the leaf in `leaves` of the constructor
  };

  struct Block {
    Eigen::Vector3i first_cell;  ///< multiples of kBlockEdge
    LeafSet seen;                ///< free or occupied; what is not in `hits` is free
    std::vector<Hit> hits;       ///< by Morton order
  };

  /// Rays go from `origin` (metres) to the mean of each voxel of `leaves`, whose voxels must be
  /// leaves of `leaf_m` edge, and to `free_ends`. What is occupied in this batch stays occupied
  /// whatever ray crosses it.
  LeafBatch(const VoxelGrid& leaves,
            const std::vector<Eigen::Vector3f>& free_ends,
            const Eigen::Vector3d& origin,
            double leaf_m);

  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }

 private:
  Block& block_of(const Eigen::Vector3i& cell);
  void cast_ray(const Eigen::Vector3d& origin_cells, const Eigen::Vector3d& end_cells);

  std::vector<Block> blocks_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_of_;
  std::size_t last_ = 0;  // rays stay in a block for some steps
};

}  // namespace tsg
