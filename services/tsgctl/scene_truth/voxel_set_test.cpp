#include "services/tsgctl/scene_truth/voxel_set.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

TEST(VoxelSet, HoldsTheVoxelOfAPointAndNoOther) {
  VoxelSet voxels(0.05);
  voxels.insert({0.01F, -0.01F, 1.02F});
  voxels.insert({0.04F, -0.04F, 1.04F});  // the same voxel
  EXPECT_EQ(voxels.size(), 1U);
  EXPECT_TRUE(voxels.contains({0.02F, -0.02F, 1.01F}));
  EXPECT_FALSE(voxels.contains({0.06F, -0.02F, 1.01F}));
}

TEST(VoxelSet, KnowsWhatIsNearByWholeVoxels) {
  VoxelSet voxels(0.05);
  voxels.insert({0.01F, 0.01F, 0.01F});
  EXPECT_TRUE(voxels.has_near({0.06F, 0.06F, 0.06F}, 1));
  EXPECT_FALSE(voxels.has_near({0.06F, 0.06F, 0.06F}, 0));
  EXPECT_FALSE(voxels.has_near({0.11F, 0.01F, 0.01F}, 1));
  EXPECT_TRUE(voxels.has_near({0.11F, 0.01F, 0.01F}, 2));
}

TEST(VoxelSet, ComesBackFromItsFileAlsoWhereOctoMapJoinsLeaves) {
  VoxelSet voxels(0.05);
  for (int i = 0; i < 1000; ++i) {  // a cube of 10 voxels a side, and one apart
    voxels.insert({0.05F * static_cast<float>(i % 10) + 0.02F,
                   0.05F * static_cast<float>(i / 10 % 10) + 0.02F,
                   0.05F * static_cast<float>(i / 100) + 0.02F});
  }
  voxels.insert({3.0F, -2.0F, 1.0F});
  const auto read = VoxelSet::from_bt(voxels.to_bt(), "people.bt");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->size(), 1001U);
  EXPECT_DOUBLE_EQ(read->edge_m(), 0.05);
  EXPECT_TRUE(read->contains({0.49F, 0.49F, 0.01F}));
  EXPECT_FALSE(read->contains({0.51F, 0.49F, 0.01F}));
}

TEST(VoxelSet, RefusesWhatIsNoOctree) {
  for (const char* bytes : {"", "people", "# Octomap OcTree binary file\nid OcTree\nsize 3\n"}) {
    const auto read = VoxelSet::from_bt(bytes, "people.bt");
    ASSERT_FALSE(read) << bytes;
    EXPECT_EQ(read.error().code, ExitCode::kBadData);
    EXPECT_NE(read.error().message.find("people.bt is no octree"), std::string::npos);
  }
}

}  // namespace
}  // namespace tsg
