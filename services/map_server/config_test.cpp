#include "services/map_server/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/error.hpp"

namespace tsg {
namespace {

using testing::HasSubstr;

MapServerConfig load(const std::vector<std::string>& overrides) {
  return load_map_server_config(ConfigFile::from_overrides(overrides));
}

TEST(MapServerConfig, ReadsEveryKey) {
  const MapServerConfig config = load(
      {"map_server.queue_keyframes=3", "map_server.resolution_m=0.1",
       "map_server.cloud_voxel_m=0.02", "map_server.max_extent_m=50",
       "map_server.depth.min_depth_m=0.5", "map_server.depth.max_depth_m=4",
       "map_server.depth.max_inverse_depth_step=0.03",
       "map_server.exclusion.dynamic_classes=[person, robot]",
       "map_server.exclusion.mask_margin_px=2", "map_server.exclusion.mask_growth_px=7",
       "map_server.exclusion.mask_growth_depth_ratio=0.05",
       "map_server.occupancy.hit_probability=0.8", "map_server.occupancy.miss_probability=0.3",
       "map_server.occupancy.min_probability=0.2", "map_server.occupancy.max_probability=0.9"});
  EXPECT_EQ(config.queue_keyframes, 3);
  EXPECT_EQ(config.map.octree.resolution_m, 0.1);
  EXPECT_EQ(config.map.cloud_voxel_m, 0.02);
  EXPECT_EQ(config.map.max_extent_m, 50.0);
  EXPECT_EQ(config.map.depth.min_depth_m, 0.5);
  EXPECT_EQ(config.map.depth.max_depth_m, 4.0);
  EXPECT_EQ(config.map.depth.max_inverse_depth_step, 0.03);
  EXPECT_THAT(config.map.exclusion.dynamic_classes, testing::ElementsAre("person", "robot"));
  EXPECT_EQ(config.map.exclusion.margin_px, 2);
  EXPECT_EQ(config.map.exclusion.growth_px, 7);
  EXPECT_EQ(config.map.exclusion.growth_depth_ratio, 0.05);
  EXPECT_EQ(config.map.octree.hit_probability, 0.8);
  EXPECT_EQ(config.map.octree.miss_probability, 0.3);
  EXPECT_EQ(config.map.octree.min_probability, 0.2);
  EXPECT_EQ(config.map.octree.max_probability, 0.9);
}

TEST(MapServerConfig, ReadsEveryKeyOfTheTags) {
  const TagConfig tags =
      load({"map_server.tags.voxel_m=0.03", "map_server.tags.max_voxels=5000",
            "map_server.tags.min_points=50", "map_server.tags.min_overlap=0.2",
            "map_server.tags.sure_overlap=0.45", "map_server.tags.merge_overlap=0.55",
            "map_server.tags.min_confidence=0.7", "map_server.tags.min_observations=4",
            "map_server.tags.gone_share=0.3", "map_server.tags.checks_per_keyframe=9"})
          .map.tags;
  EXPECT_EQ(tags.voxel_m, 0.03);
  EXPECT_EQ(tags.max_voxels, 5000);
  EXPECT_EQ(tags.min_points, 50);
  EXPECT_EQ(tags.min_overlap, 0.2);
  EXPECT_EQ(tags.sure_overlap, 0.45);
  EXPECT_EQ(tags.merge_overlap, 0.55);
  EXPECT_EQ(tags.min_confidence, 0.7);
  EXPECT_EQ(tags.min_observations, 4);
  EXPECT_EQ(tags.gone_share, 0.3);
  EXPECT_EQ(tags.checks_per_keyframe, 9);
}

TEST(MapServerConfig, ListsAllProblemsAtOnce) {
  try {
    (void)load({"map_server.resolution_m=0", "map_server.queue_keyframes=0",
                "map_server.resolutoin_m=0.1"});
    FAIL() << "nothing was found wrong";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kConfig);
    EXPECT_THAT(error.what(), HasSubstr("resolution_m must be"));
    EXPECT_THAT(error.what(), HasSubstr("queue_keyframes must be"));
    EXPECT_THAT(error.what(), HasSubstr("resolutoin_m"));
  }
}

}  // namespace
}  // namespace tsg
