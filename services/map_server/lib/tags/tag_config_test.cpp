#include "services/map_server/lib/tags/tag_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/map_server/lib/tags/tag.hpp"

namespace tsg {
namespace {

TEST(TagConfig, NamesEveryUnusableSetting) {
  EXPECT_THAT(TagConfig{}.problems(), testing::IsEmpty());
  TagConfig config;
  config.voxel_m = 0.0;
  config.max_voxels = 10;
  config.min_points = 0;
  config.min_overlap = 1.0;
  config.sure_overlap = 0.0;
  config.merge_overlap = -1.0;
  config.min_confidence = 2.0;
  config.min_observations = 0;
  config.gone_share = 1.5;
  config.checks_per_keyframe = -1;
  EXPECT_THAT(config.problems(), testing::SizeIs(10));
  EXPECT_THAT(config.problems(), testing::Contains("tags.gone_share must be > 0 and < 1"));
}

TEST(TagState, HasAName) {
  EXPECT_EQ(name_of(TagState::kStatic), "static");
  EXPECT_EQ(name_of(TagState::kMoved), "moved");
  EXPECT_EQ(name_of(TagState::kGone), "gone");
}

}  // namespace
}  // namespace tsg
