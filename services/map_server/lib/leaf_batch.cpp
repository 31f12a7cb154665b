#include "services/map_server/lib/leaf_batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tsg {
namespace {

/// Spreads the three bits of a coordinate within a block: abc -> 00a00b00c.
constexpr std::array<unsigned, 8> kSpread{0, 1, 8, 9, 64, 65, 72, 73};

unsigned morton_of(const Eigen::Vector3i& cell) {
  constexpr int kMask = LeafBatch::kBlockEdge - 1;
  return kSpread[static_cast<unsigned>(cell.x() & kMask)] |
         kSpread[static_cast<unsigned>(cell.y() & kMask)] << 1U |
         kSpread[static_cast<unsigned>(cell.z() & kMask)] << 2U;
}

Eigen::Vector3i block_origin(const Eigen::Vector3i& cell) {
  constexpr int kMask = ~(LeafBatch::kBlockEdge - 1);
  return {cell.x() & kMask, cell.y() & kMask, cell.z() & kMask};
}

std::uint64_t pack(const Eigen::Vector3i& cell) {
  constexpr std::uint64_t kMask = (1U << 21U) - 1U;
  return (static_cast<std::uint64_t>(cell.x()) & kMask) |
         (static_cast<std::uint64_t>(cell.y()) & kMask) << 21U |
         (static_cast<std::uint64_t>(cell.z()) & kMask) << 42U;
}

/// Steps through the cells that a segment crosses (Amanatides and Woo 1987); units are cells.
class CellWalk {
 public:
  CellWalk(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
      : cell_(from.array().floor().cast<int>()) {
    const Eigen::Vector3i last = to.array().floor().cast<int>();
    steps_left_ = (last - cell_).cwiseAbs().sum();
    const Eigen::Vector3d along = to - from;
    for (int axis = 0; axis < 3; ++axis) {
      step_[axis] = along[axis] > 0.0 ? 1 : -1;
      if (last[axis] == cell_[axis]) continue;  // never crosses a border of this axis
      const double border = cell_[axis] + (step_[axis] > 0 ? 1.0 : 0.0);
      next_[axis] = (border - from[axis]) / along[axis];
      per_cell_[axis] = std::abs(1.0 / along[axis]);
    }
  }

  [[nodiscard]] const Eigen::Vector3i& cell() const { return cell_; }
  /// True once the cell of the end is reached.
  [[nodiscard]] bool is_at_end() const { return steps_left_ <= 0; }
  void advance() {
    int axis = next_[0] < next_[1] ? 0 : 1;
    if (next_[2] < next_[axis]) axis = 2;
    cell_[axis] += step_[axis];
    next_[axis] += per_cell_[axis];
    --steps_left_;
  }

 private:
  Eigen::Vector3i cell_;
  Eigen::Vector3i step_;
  int steps_left_;  // a count, so that rounding cannot lead past the end
  Eigen::Vector3d next_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d per_cell_ = Eigen::Vector3d::Zero();
};

}  // namespace

bool LeafBatch::LeafSet::intersects(unsigned level, unsigned index) const {
  switch (level) {
    case 0:
      return contains(index);
    case 1:
      return (words_[index / 8] >> (index % 8 * 8) & 0xffU) != 0;
    case 2:
      return words_[index] != 0;
    default:
      return std::any_of(words_.begin(), words_.end(),
                         [](std::uint64_t word) { return word != 0; });
  }
}

LeafBatch::LeafBatch(const VoxelGrid& leaves,
                     const std::vector<Eigen::Vector3f>& free_ends,
                     const Eigen::Vector3d& origin,
                     double leaf_m) {
  const Eigen::Vector3d origin_cells = origin / leaf_m;
  for (std::uint32_t i = 0; i < leaves.size(); ++i) {
    const Voxel leaf = leaves.voxel(i);
    // The mean may be rounded across the border of its cell.
    const Eigen::Vector3d low = leaf.cell.cast<double>();
    const Eigen::Vector3d end = (leaf.mean.position.cast<double>() / leaf_m)
                                    .cwiseMax(low)
                                    .cwiseMin((low.array() + (1.0 - 1e-6)).matrix());
    cast_ray(origin_cells, end);
    Block& block = block_of(leaf.cell);
    block.hits.push_back({morton_of(leaf.cell), i});
    block.seen.insert(block.hits.back().morton);
  }
  for (const Eigen::Vector3f& end : free_ends) cast_ray(origin_cells, end.cast<double>() / leaf_m);
  for (Block& block : blocks_) {
    std::sort(block.hits.begin(), block.hits.end(),
              [](const Hit& a, const Hit& b) { return a.morton < b.morton; });
  }
}

LeafBatch::Block& LeafBatch::block_of(const Eigen::Vector3i& cell) {
  const Eigen::Vector3i first = block_origin(cell);
  if (last_ < blocks_.size() && blocks_[last_].first_cell == first) return blocks_[last_];
  const auto [found, is_new] =
      index_of_.try_emplace(pack(first), static_cast<std::uint32_t>(blocks_.size()));
  if (is_new) blocks_.push_back({first, {}, {}});
  last_ = found->second;
  return blocks_[last_];
}

void LeafBatch::cast_ray(const Eigen::Vector3d& origin_cells, const Eigen::Vector3d& end_cells) {
  for (CellWalk walk(origin_cells, end_cells); !walk.is_at_end(); walk.advance()) {
    block_of(walk.cell()).seen.insert(morton_of(walk.cell()));
  }
}

}  // namespace tsg
