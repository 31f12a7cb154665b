#include "services/tsgctl/scene_truth/voxel_set.hpp"

#include <cmath>
#include <sstream>
#include <utility>

#include "common/core/check.hpp"

namespace tsg {
namespace {

/// The header of OctoMap's binary files; its own reader writes to stderr where this is absent.
constexpr const char* kBtHeader = "# Octomap OcTree binary file";

octomap::point3d to_octomap(const Eigen::Vector3f& point) {
  return {point.x(), point.y(), point.z()};
}

}  // namespace

VoxelSet::VoxelSet(double edge_m) : tree_(std::make_unique<octomap::OcTree>(edge_m)) {}

void VoxelSet::insert(const Eigen::Vector3f& point) {
  if (contains(point)) return;
  tree_->setNodeValue(to_octomap(point), tree_->getClampingThresMaxLog(), /*lazy_eval=*/true);
}

bool VoxelSet::contains(const Eigen::Vector3f& point) const {
  return tree_->search(to_octomap(point)) != nullptr;
}

bool VoxelSet::has_near(const Eigen::Vector3f& point, int voxels) const {
  const auto edge = static_cast<float>(edge_m());
  for (int x = -voxels; x <= voxels; ++x) {
    for (int y = -voxels; y <= voxels; ++y) {
      for (int z = -voxels; z <= voxels; ++z) {
        const Eigen::Vector3i step(x, y, z);
        if (contains(point + edge * step.cast<float>())) return true;
      }
    }
  }
  return false;
}

std::size_t VoxelSet::size() const {
  std::size_t count = 0;
  for (auto leaf = tree_->begin_leafs(), end = tree_->end_leafs(); leaf != end; ++leaf) {
    const auto edge = static_cast<std::size_t>(std::lround(leaf.getSize() / edge_m()));
    count += edge * edge * edge;
  }
  return count;
}

std::string VoxelSet::to_bt() {
  tree_->updateInnerOccupancy();
  std::ostringstream stream;
  TSG_CHECK(tree_->writeBinary(stream));
  return std::move(stream).str();
}

Expected<VoxelSet> VoxelSet::from_bt(const std::string& bytes, const std::string& name) {
  const auto damaged = [&] {
    return make_error(ExitCode::kBadData, name +
                                              " is no octree in OctoMap's binary format; render "
                                              "the sequence anew (tsgctl simulate)");
  };
  if (!bytes.starts_with(kBtHeader)) return damaged();
  auto tree = std::make_unique<octomap::OcTree>(1.0);
  std::istringstream stream(bytes);
  if (!tree->readBinary(stream) || !stream) return damaged();
  return VoxelSet(std::move(tree));
}

}  // namespace tsg
