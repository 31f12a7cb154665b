#pragma once

#include <octomap/ColorOcTree.h>

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/map_server/lib/class_table.hpp"
#include "services/map_server/lib/cloud.hpp"
#include "services/map_server/lib/leaf_batch.hpp"
#include "services/map_server/lib/voxel_grid.hpp"

namespace tsg {

struct OctreeConfig {
  double resolution_m = 0.05;  ///< edge of a leaf at depth 16 (paper, section 6.2)
  /// Sensor model of eq. 8-9: three misses undo a hit or two; values of the OctoMap paper.
  double hit_probability = 0.7;
  double miss_probability = 0.4;
  /// Bounds of a leaf's probability, so that the map can still follow a change after minutes.
  double min_probability = 0.12;
  double max_probability = 0.97;

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// What a map knows of a place.
enum class Place { kUnknown, kFree, kOccupied };

/// A node of OctoMap's colour tree that also knows its class. Written to files as such a node.
class SemanticNode : public octomap::ColorOcTreeNode {
 public:
  void copyData(const SemanticNode& from) {
    ColorOcTreeNode::copyData(from);
    class_id_ = from.class_id_;
    confidence_ = from.confidence_;
  }
  [[nodiscard]] ClassId class_id() const { return class_id_; }

  /// Takes in what one keyframe saw of this leaf: votes for the class, and sets the colour: of the
  /// class where it is an object's, else the mean of what was seen.
  void observe(const CloudPoint& seen, const ClassTable& classes);
  /// Forgets class and colour: what was here is gone.
  void clear_appearance();

 private:
  ClassId class_id_ = kNotSegmentedClass;
  std::uint8_t confidence_ = 0;  // lead of class_id_ over all other classes, in keyframes
};

/// The paper's semantic octree: OctoMap's occupancy tree with colours by class. Leaves are updated
/// in batches (LeafBatch), a descent for 512 leaves. Occupied leaves are never merged, so each is
/// resolution_m wide; free space is merged once its probability is at the lower bound.
class SemanticOctree : public octomap::OccupancyOcTreeBase<SemanticNode> {
 public:
  explicit SemanticOctree(const OctreeConfig& config);
  SemanticOctree(const SemanticOctree&) = delete;  // OctoMap's copies lose the type of the nodes
  SemanticOctree& operator=(const SemanticOctree&) = delete;
  SemanticOctree(SemanticOctree&&) = delete;
  SemanticOctree& operator=(SemanticOctree&&) = delete;
  ~SemanticOctree() override = default;

  /// Integrates one keyframe: `points` (world, metres) are occupied; the space between `origin`,
  /// the camera, and them or `free_ends` is free.
  void integrate(const Eigen::Vector3d& origin,
                 const Cloud& points,
                 const std::vector<Eigen::Vector3f>& free_ends,
                 const ClassTable& classes);

  [[nodiscard]] Place place_at(const Eigen::Vector3f& position) const;
  [[nodiscard]] bool is_occupied_at(const Eigen::Vector3f& position) const;

  struct LeafCounts {
    std::size_t occupied = 0;
    std::size_t free = 0;  ///< nodes: merged free space counts once
    std::map<ClassId, std::size_t> occupied_by_class;
  };
  [[nodiscard]] LeafCounts count_leaves() const;

  /// The `.ot` format of octovis: probabilities and colours, under the name of OctoMap's colour
  /// tree.
  [[nodiscard]] std::string to_ot() const;
  /// The `.bt` format: each leaf occupied or free, equal neighbours merged.
  [[nodiscard]] std::string to_bt() const;

  // What OctoMap asks of a tree type.
  [[nodiscard]] SemanticOctree* create() const override { return new SemanticOctree(config_); }
  [[nodiscard]] std::string getTreeType() const override { return "ColorOcTree"; }
  [[nodiscard]] bool isNodeCollapsible(const SemanticNode* node) const override;

 private:
  struct Update;  // of one block: what all of its recursion needs

  void update_path(SemanticNode* node, unsigned depth, bool is_new, Update& update);
  void update_subtree(
      SemanticNode* node, unsigned level, unsigned index, bool is_new, Update& update);
  void update_leaf(SemanticNode* node, unsigned morton, Update& update);
  /// The child to go on with, made where it is absent; `is_new` says whether it was.
  SemanticNode* child_for_update(SemanticNode* node, unsigned child, bool& is_new);
  void finish_inner(SemanticNode* node);
  [[nodiscard]] bool is_surely_free(const SemanticNode* node) const;

  OctreeConfig config_;
  VoxelGrid seen_leaves_;  // of the keyframe being integrated
};

}  // namespace tsg
