#include "services/map_server/lib/semantic_octree.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <memory>
#include <random>
#include <sstream>

namespace tsg {
namespace {

constexpr ClassId kChair = 57;
constexpr ClassId kTv = 63;
const Eigen::Vector3d kOrigin(0.025, 0.025, 0.025);

CloudPoint point_at(float x, ClassId class_id = kBackgroundClass, Rgb colour = {10, 20, 30}) {
  return {{x, 0.025F, 0.025F}, colour, class_id, 1};
}

/// A point in each of the 80 x 80 leaves of a wall 1.5 m ahead.
Cloud wall_ahead() {
  Cloud wall;
  for (int y = -40; y < 40; ++y) {
    for (int z = -40; z < 40; ++z) {
      const Eigen::Vector3f corner(1.5F, 0.05F * static_cast<float>(y),
                                   0.05F * static_cast<float>(z));
      wall.push_back({corner.array() + 0.025F, {1, 2, 3}, kBackgroundClass, 1});
    }
  }
  return wall;
}

class SemanticOctreeTest : public testing::Test {
 protected:
  void see(const Cloud& points, int times = 1) {
    for (int i = 0; i < times; ++i) tree_.integrate(kOrigin, points, {}, classes_);
  }
  const SemanticNode* node_at(double x) { return tree_.search(x, 0.025, 0.025); }

  ClassTable classes_;
  SemanticOctree tree_{OctreeConfig{}};
};

TEST_F(SemanticOctreeTest, AddsLogOddsAsInEquationEight) {
  see({point_at(1.025F)}, 2);
  ASSERT_NE(node_at(1.025), nullptr);
  EXPECT_NEAR(node_at(1.025)->getLogOdds(), 2 * std::log(0.7 / 0.3), 1e-5);
  EXPECT_NEAR(node_at(0.525)->getLogOdds(), 2 * std::log(0.4 / 0.6), 1e-5);
  EXPECT_EQ(node_at(1.075), nullptr);  // behind what was seen nothing is known
}

TEST_F(SemanticOctreeTest, KeepsProbabilitiesWithinTheirBounds) {
  see({point_at(1.025F)}, 100);
  EXPECT_NEAR(node_at(1.025)->getOccupancy(), 0.97, 1e-5);
  EXPECT_NEAR(node_at(0.525)->getOccupancy(), 0.12, 1e-5);
}

TEST_F(SemanticOctreeTest, ForgetsWhatIsSeenThrough) {
  see({point_at(1.025F, kChair)}, 2);
  see({point_at(2.025F)}, 5);
  EXPECT_FALSE(tree_.is_occupied_at({1.025F, 0.025F, 0.025F}));
  EXPECT_TRUE(tree_.is_occupied_at({2.025F, 0.025F, 0.025F}));
  EXPECT_EQ(node_at(1.025)->class_id(), kNotSegmentedClass);
  EXPECT_FALSE(node_at(1.025)->isColorSet());
}

TEST_F(SemanticOctreeTest, ColoursBackgroundByTheImageAndObjectsByTheirClass) {
  see({point_at(1.025F), point_at(2.025F, kChair)});
  EXPECT_EQ(node_at(1.025)->getColor(), octomap::ColorOcTreeNode::Color(10, 20, 30));
  const Rgb chair = classes_.colour_of(kChair);
  EXPECT_EQ(node_at(2.025)->getColor(), octomap::ColorOcTreeNode::Color(chair.r, chair.g, chair.b));
}

TEST_F(SemanticOctreeTest, AveragesTheColourOfWhatHasNoClass) {
  see({point_at(1.025F, kBackgroundClass, {100, 100, 100})});
  see({point_at(1.025F, kNotSegmentedClass, {50, 50, 50})});
  EXPECT_EQ(node_at(1.025)->getColor(), octomap::ColorOcTreeNode::Color(75, 75, 75));
  EXPECT_EQ(node_at(1.025)->class_id(), kBackgroundClass);
}

TEST_F(SemanticOctreeTest, BelievesTheClassThatMostKeyframesSaw) {
  see({point_at(1.025F, kChair)}, 3);
  see({point_at(1.025F, kTv)}, 2);
  EXPECT_EQ(node_at(1.025)->class_id(), kChair);
  see({point_at(1.025F, kTv)}, 2);
  EXPECT_EQ(node_at(1.025)->class_id(), kTv);
}

TEST_F(SemanticOctreeTest, MergesFreeSpaceOnceItIsSureAndNeverOccupiedLeaves) {
  const Cloud wall = wall_ahead();
  see(wall, 3);
  const auto before = tree_.count_leaves();
  see(wall, 20);
  const auto after = tree_.count_leaves();
  EXPECT_EQ(before.occupied, 80U * 80U);
  EXPECT_EQ(after.occupied, 80U * 80U);
  EXPECT_LT(after.free, before.free / 2);
  EXPECT_EQ(tree_.size(), tree_.calcNumNodes());
}

TEST_F(SemanticOctreeTest, SplitsMergedSpaceWhereSomethingIsPutThere) {
  const Cloud wall = wall_ahead();
  see(wall, 10);
  const float x = 0.825F;
  ASSERT_FALSE(tree_.is_occupied_at({x, 0.025F, 0.025F}));
  see({point_at(x, kChair)}, 5);
  EXPECT_TRUE(tree_.is_occupied_at({x, 0.025F, 0.025F}));
  EXPECT_EQ(node_at(x)->class_id(), kChair);
  EXPECT_FALSE(tree_.is_occupied_at({x + 0.05F, 0.025F, 0.025F}));  // its neighbours stay free
  EXPECT_NEAR(node_at(x + 0.05)->getOccupancy(), 0.12, 1e-5);
  EXPECT_EQ(tree_.size(), tree_.calcNumNodes());
}

/// Any cloud, some of it labelled.
Cloud random_cloud(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-2.0F, 2.0F);
  std::uniform_int_distribution<int> byte(0, 200);
  Cloud cloud;
  for (int i = 0; i < 400; ++i) {
    const auto channel = static_cast<std::uint8_t>(byte(random));
    cloud.push_back({{coordinate(random), coordinate(random), coordinate(random)},
                     {channel, channel, channel},
                     static_cast<ClassId>(byte(random) % 81),
                     1});
  }
  return cloud;
}

/// What SemanticOctree does in batches, leaf by leaf by OctoMap's own means.
void update_every_leaf(octomap::OcTree& tree, const Cloud& cloud) {
  VoxelGrid leaves(tree.getResolution());
  for (const CloudPoint& point : cloud) leaves.add(point);
  const LeafBatch batch(leaves, {}, kOrigin, tree.getResolution());
  for (const auto& block : batch.blocks()) {
    std::size_t hit = 0;
    for (unsigned morton = 0; morton < 512; ++morton) {
      if (!block.seen.contains(morton)) continue;
      octomap::OcTreeKey key;
      for (unsigned axis = 0; axis < 3; ++axis) {
        const unsigned offset = (morton >> axis & 1U) | (morton >> (axis + 3) & 1U) << 1U |
                                (morton >> (axis + 6) & 1U) << 2U;
        key[axis] = static_cast<std::uint16_t>(block.first_cell[axis] + int(offset) + 32768);
      }
      const bool is_hit = hit < block.hits.size() && block.hits[hit].morton == morton;
      hit += is_hit ? 1 : 0;
      tree.updateNode(key, is_hit);
    }
  }
}

TEST_F(SemanticOctreeTest, EqualsUpdatingEveryLeafByItselfForAnyClouds) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE(kSeed);
  octomap::OcTree reference(0.05);
  reference.setProbHit(0.7);
  reference.setProbMiss(0.4);
  reference.setClampingThresMin(0.12);
  reference.setClampingThresMax(0.97);
  for (unsigned round = 0; round < 8; ++round) {
    const Cloud cloud = random_cloud(kSeed + round % 3);
    update_every_leaf(reference, cloud);
    see(cloud);
  }
  reference.expand();
  for (auto leaf = reference.begin_leafs(); leaf != reference.end_leafs(); ++leaf) {
    const SemanticNode* node = tree_.search(leaf.getKey());
    ASSERT_NE(node, nullptr);
    EXPECT_NEAR(node->getLogOdds(), leaf->getLogOdds(), 1e-5);
  }
  tree_.expand();
  EXPECT_EQ(tree_.getNumLeafNodes(), reference.getNumLeafNodes());
}

TEST_F(SemanticOctreeTest, WritesOtFilesThatOctoMapReadsBackEqual) {
  for (unsigned round = 0; round < 4; ++round) see(random_cloud(round));
  std::istringstream stream(tree_.to_ot());
  const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(stream));
  const auto* colours = dynamic_cast<octomap::ColorOcTree*>(read.get());
  ASSERT_NE(colours, nullptr);
  EXPECT_EQ(colours->size(), tree_.size());
  EXPECT_DOUBLE_EQ(colours->getResolution(), 0.05);
  for (auto leaf = tree_.begin_leafs(); leaf != tree_.end_leafs(); ++leaf) {
    const auto* node = colours->search(leaf.getKey(), leaf.getDepth());
    ASSERT_NE(node, nullptr);
    EXPECT_EQ(node->getLogOdds(), leaf->getLogOdds());
    EXPECT_EQ(node->getColor(), leaf->getColor());
  }
}

TEST_F(SemanticOctreeTest, WritesBtFilesThatOctoMapReadsBackWithTheSameOccupancy) {
  for (unsigned round = 0; round < 4; ++round) see(random_cloud(round));
  std::istringstream stream(tree_.to_bt());
  octomap::OcTree read(0.1);
  ASSERT_TRUE(read.readBinary(stream));
  EXPECT_DOUBLE_EQ(read.getResolution(), 0.05);
  for (auto leaf = tree_.begin_leafs(); leaf != tree_.end_leafs(); ++leaf) {
    const auto* node = read.search(leaf.getKey());
    ASSERT_NE(node, nullptr);
    EXPECT_EQ(read.isNodeOccupied(node), tree_.isNodeOccupied(*leaf));
  }
}

TEST_F(SemanticOctreeTest, WritesReadableFilesWhileItIsEmpty) {
  std::istringstream ot(tree_.to_ot());
  const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(ot));
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->size(), 0U);
  std::istringstream bt(tree_.to_bt());
  octomap::OcTree binary(0.1);
  EXPECT_TRUE(binary.readBinary(bt));
}

TEST(OctreeConfig, NamesEveryUnusableSetting) {
  EXPECT_TRUE(OctreeConfig{}.problems().empty());
  EXPECT_EQ((OctreeConfig{0.0, 0.4, 0.6, 0.7, 0.3}.problems().size()), 5U);
}

}  // namespace
}  // namespace tsg
