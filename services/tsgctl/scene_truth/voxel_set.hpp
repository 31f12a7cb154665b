#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>

#include "common/core/error.hpp"

namespace tsg {

/// A set of cubes of space, aligned with the axes: what truth says is filled. Kept as an octree, so
/// that its file opens in octovis. Coordinates in metres, within +-1600 m at 5 cm.
class VoxelSet {
 public:
  explicit VoxelSet(double edge_m);

  void insert(const Eigen::Vector3f& point);
  [[nodiscard]] bool contains(const Eigen::Vector3f& point) const;
  /// True where the voxel of `point`, or one within `voxels` of it along each axis, is in the set.
  [[nodiscard]] bool has_near(const Eigen::Vector3f& point, int voxels) const;
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] double edge_m() const { return tree_->getResolution(); }

  /// OctoMap's binary format (.bt): occupied leaves are the set.
  [[nodiscard]] std::string to_bt();
  /// kBadData where `bytes` are no such file; `name` is what the message calls it.
  [[nodiscard]] static Expected<VoxelSet> from_bt(const std::string& bytes,
                                                  const std::string& name);

 private:
  explicit VoxelSet(std::unique_ptr<octomap::OcTree> tree) : tree_(std::move(tree)) {}
  std::unique_ptr<octomap::OcTree> tree_;  // OctoMap's trees cannot be moved
};

}  // namespace tsg
