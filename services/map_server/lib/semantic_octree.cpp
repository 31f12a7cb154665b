#include "services/map_server/lib/semantic_octree.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/core/check.hpp"

namespace tsg {
namespace {

/// Keyframes by which a class can lead at most: a wrong label is outvoted after so many.
constexpr std::uint8_t kMaxConfidence = 20;

octomap::ColorOcTreeNode::Color to_octomap(const Rgb& colour) {
  return {colour.r, colour.g, colour.b};
}

std::uint8_t mean(std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>((a + b) / 2); }

bool is_probability(double value) { return value > 0.0 && value < 1.0; }

}  // namespace

std::vector<std::string> OctreeConfig::problems() const {
  std::vector<std::string> found;
  if (!(resolution_m >= 0.005 && resolution_m <= 1.0)) {
    found.emplace_back("resolution_m must be 0.005..1");
  }
  if (!(hit_probability > 0.5 && hit_probability < 1.0)) {
    found.emplace_back("hit_probability must be above 0.5 and below 1");
  }
  if (!(miss_probability > 0.0 && miss_probability < 0.5)) {
    found.emplace_back("miss_probability must be above 0 and below 0.5");
  }
  if (!is_probability(min_probability) || !(min_probability < miss_probability)) {
    found.emplace_back("min_probability must be above 0 and below miss_probability");
  }
  if (!is_probability(max_probability) || !(max_probability > hit_probability)) {
    found.emplace_back("max_probability must be above hit_probability and below 1");
  }
  return found;
}

void SemanticNode::observe(const CloudPoint& seen, const ClassTable& classes) {
  const bool had_object_colour = is_object_class(class_id_);
  if (seen.class_id == kNotSegmentedClass) {
    // Without a mask it says nothing about the class.
  } else if (seen.class_id == class_id_) {
    confidence_ =
        std::min<std::uint8_t>(kMaxConfidence, static_cast<std::uint8_t>(confidence_ + 1));
  } else if (confidence_ == 0) {
    class_id_ = seen.class_id;
    confidence_ = 1;
  } else {
    --confidence_;
  }

  if (is_object_class(class_id_)) {
    color = to_octomap(classes.colour_of(class_id_));
  } else if (isColorSet() && !had_object_colour) {
    color = {mean(color.r, seen.colour.r), mean(color.g, seen.colour.g),
             mean(color.b, seen.colour.b)};
  } else {
    color = to_octomap(seen.colour);
  }
}

void SemanticNode::clear_appearance() {
  color = Color();
  class_id_ = kNotSegmentedClass;
  confidence_ = 0;
}

/// A block being written into the tree.
struct SemanticOctree::Update {
  const LeafBatch::Block& block;
  octomap::OcTreeKey key;  ///< of the block's first leaf
  const VoxelGrid& leaves;
  const ClassTable& classes;
  std::size_t next_hit = 0;  ///< leaves are visited in Morton order, in which the hits are sorted

  [[nodiscard]] bool has_hit_below(unsigned morton_end) const {
    return next_hit < block.hits.size() && block.hits[next_hit].morton < morton_end;
  }
};

SemanticOctree::SemanticOctree(const OctreeConfig& config)
    : OccupancyOcTreeBase<SemanticNode>(config.resolution_m),
      config_(config),
      seen_leaves_(config.resolution_m) {
  setProbHit(config.hit_probability);
  setProbMiss(config.miss_probability);
  setClampingThresMin(config.min_probability);
  setClampingThresMax(config.max_probability);
}

void SemanticOctree::integrate(const Eigen::Vector3d& origin,
                               const Cloud& points,
                               const std::vector<Eigen::Vector3f>& free_ends,
                               const ClassTable& classes) {
  seen_leaves_.clear();
  for (const CloudPoint& point : points) seen_leaves_.add(point);
  const LeafBatch batch(seen_leaves_, free_ends, origin, resolution);
  for (const LeafBatch::Block& block : batch.blocks()) {
    const Eigen::Vector3i first = block.first_cell.array() + static_cast<int>(tree_max_val);
    Update update{
        block,
        {static_cast<octomap::key_type>(first.x()), static_cast<octomap::key_type>(first.y()),
         static_cast<octomap::key_type>(first.z())},
        seen_leaves_,
        classes};
    const bool is_new = root == nullptr;
    if (is_new) {
      root = new SemanticNode();  // owned and deleted by OctoMap's base class
      ++tree_size;
    }
    update_path(root, 0, is_new, update);
  }
  size_changed = true;
}

void SemanticOctree::update_path(SemanticNode* node, unsigned depth, bool is_new, Update& update) {
  if (depth + LeafBatch::kBlockLevel == tree_depth) {
    update_subtree(node, LeafBatch::kBlockLevel, 0, is_new, update);
    return;
  }
  if (!is_new && is_surely_free(node) && update.block.hits.empty()) return;
  const unsigned child =
      octomap::computeChildIdx(update.key, static_cast<int>(tree_depth - 1 - depth));
  bool is_child_new = is_new;
  SemanticNode* next = child_for_update(node, child, is_child_new);
  update_path(next, depth + 1, is_child_new, update);
  finish_inner(node);
}

void SemanticOctree::update_subtree(
    SemanticNode* node, unsigned level, unsigned index, bool is_new, Update& update) {
  if (level == 0) {
    update_leaf(node, index, update);
    return;
  }
  const unsigned morton_end = (index + 1) << (3 * level);
  if (!is_new && is_surely_free(node) && !update.has_hit_below(morton_end)) return;
  for (unsigned child = 0; child < 8; ++child) {
    const unsigned child_index = 8 * index + child;
    if (!update.block.seen.intersects(level - 1, child_index)) continue;
    bool is_child_new = is_new;
    SemanticNode* next = child_for_update(node, child, is_child_new);
    update_subtree(next, level - 1, child_index, is_child_new, update);
  }
  finish_inner(node);
}

void SemanticOctree::update_leaf(SemanticNode* node, unsigned morton, Update& update) {
  if (update.has_hit_below(morton + 1)) {
    const LeafBatch::Hit& hit = update.block.hits[update.next_hit++];
    updateNodeLogOdds(node, prob_hit_log);
    node->observe(update.leaves.voxel(hit.index).mean, update.classes);
  } else {
    updateNodeLogOdds(node, prob_miss_log);
  }
  if (!isNodeOccupied(node)) node->clear_appearance();
}

SemanticNode* SemanticOctree::child_for_update(SemanticNode* node, unsigned child, bool& is_new) {
  if (nodeChildExists(node, child)) {
    is_new = false;
    return getNodeChild(node, child);
  }
  const bool was_merged = !is_new && !nodeHasChildren(node);
  if (was_merged) {
    expandNode(node);
    is_new = false;
    return getNodeChild(node, child);
  }
  is_new = true;
  return createNodeChild(node, child);
}

void SemanticOctree::finish_inner(SemanticNode* node) {
  if (pruneNode(node)) return;
  node->updateOccupancyChildren();
  node->updateColorChildren();
}

bool SemanticOctree::is_surely_free(const SemanticNode* node) const {
  return !nodeHasChildren(node) && node->getLogOdds() <= clamping_thres_min;
}

bool SemanticOctree::isNodeCollapsible(const SemanticNode* node) const {
  for (unsigned child = 0; child < 8; ++child) {
    if (!nodeChildExists(node, child) || !is_surely_free(getNodeChild(node, child))) return false;
  }
  return true;
}

Place SemanticOctree::place_at(const Eigen::Vector3f& position) const {
  const SemanticNode* node = search(position.x(), position.y(), position.z());
  if (node == nullptr) return Place::kUnknown;
  return isNodeOccupied(node) ? Place::kOccupied : Place::kFree;
}

bool SemanticOctree::is_occupied_at(const Eigen::Vector3f& position) const {
  return place_at(position) == Place::kOccupied;
}

SemanticOctree::LeafCounts SemanticOctree::count_leaves() const {
  LeafCounts counts;
  for (auto leaf = begin_leafs(), end = end_leafs(); leaf != end; ++leaf) {
    if (isNodeOccupied(*leaf)) {
      ++counts.occupied;
      ++counts.occupied_by_class[leaf->class_id()];
    } else {
      ++counts.free;
    }
  }
  return counts;
}

std::string SemanticOctree::to_ot() const {
  std::ostringstream stream;
  TSG_CHECK(write(stream));
  return std::move(stream).str();
}

std::string SemanticOctree::to_bt() const {
  // Through OctoMap's own binary reader, since merging must not touch this tree.
  std::stringstream unmerged;
  TSG_CHECK(writeBinaryConst(unmerged));
  octomap::OcTree merged(resolution);
  TSG_CHECK(merged.readBinary(unmerged));
  merged.prune();
  std::ostringstream stream;
  TSG_CHECK(merged.writeBinaryConst(stream));
  return std::move(stream).str();
}

}  // namespace tsg
