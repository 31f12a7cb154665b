#include "services/tsgctl/map_eval/object_score.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

Tag tag(std::uint32_t id, const std::string& class_name, const Eigen::Vector3f& centre) {
  Tag made;
  made.id = id;
  made.class_name = class_name;
  made.centre = centre;
  made.oriented_box = {centre, {0.6F, 0.5F, 1.0F}, 0.0F};
  return made;
}

ExpectedObject object(int id, const std::string& class_name, const Eigen::Vector3f& centre) {
  return {.id = id,
          .class_name = class_name,
          .name = class_name + "_" + std::to_string(id),
          .box = {0, centre, {0.5F, 0.6F, 1.0F}, 0.0F},
          .is_well_seen = true};
}

TEST(ObjectScore, MeasuresHowFarTagsAreOff) {
  const std::vector<Tag> tags{tag(7, "chair", {1.03F, 2.0F, 0.54F})};
  const ObjectScore score = score_objects(tags, {object(3, "chair", {1.0F, 2.0F, 0.5F})});
  ASSERT_EQ(score.matches.size(), 1U);
  EXPECT_EQ(score.matches[0].object_id, 3);
  EXPECT_EQ(score.matches[0].tag_id, 7U);
  EXPECT_NEAR(score.matches[0].centre_error_m, 0.05, 1e-5);
  EXPECT_NEAR(score.matches[0].size_error, 0.0, 1e-6) << "turned by 90 degrees it is the same";
  EXPECT_EQ(score.count_error(), 0U);
}

TEST(ObjectScore, TheSizeIsOffRelativeToTheTrueOne) {
  std::vector<Tag> tags{tag(7, "chair", {1.0F, 2.0F, 0.5F})};
  tags[0].oriented_box.size.z() = 0.8F;
  const ObjectScore score = score_objects(tags, {object(3, "chair", {1.0F, 2.0F, 0.5F})});
  EXPECT_NEAR(score.matches.at(0).size_error, 0.2 / std::sqrt(0.25 + 0.36 + 1.0), 1e-5);
}

TEST(ObjectScore, CountsWhatIsMissingAndWhatIsTooMuch) {
  const std::vector<Tag> tags{tag(1, "chair", {1.0F, 2.0F, 0.5F}),
                              tag(2, "chair", {1.1F, 2.1F, 0.5F}),  // the same chair twice
                              tag(3, "tv", {3.0F, 2.0F, 1.0F})};
  const ObjectScore score = score_objects(
      tags, {object(1, "chair", {1.0F, 2.0F, 0.5F}), object(2, "chair", {4.0F, 2.0F, 0.5F}),
             object(3, "laptop", {3.0F, 2.0F, 1.0F})});
  ASSERT_EQ(score.classes.size(), 3U);
  EXPECT_EQ(score.classes[0].class_name, "chair");
  EXPECT_EQ(score.classes[0].objects, 2U);
  EXPECT_EQ(score.classes[0].tags, 2U);
  EXPECT_EQ(score.classes[0].missing, 1U);
  EXPECT_EQ(score.classes[0].surplus, 1U);
  EXPECT_EQ(score.classes[1].missing, 1U) << "laptop";
  EXPECT_EQ(score.classes[2].surplus, 1U) << "tv";
  EXPECT_EQ(score.count_error(), 4U);
}

TEST(ObjectScore, WhatIsHardlySeenNeedsNoTagAndMayHaveOne) {
  std::vector<ExpectedObject> objects{object(1, "chair", {1.0F, 2.0F, 0.5F}),
                                      object(2, "cup", {3.0F, 2.0F, 0.5F})};
  for (ExpectedObject& hardly_seen : objects) hardly_seen.is_well_seen = false;
  const std::vector<Tag> tags{tag(1, "chair", {1.0F, 2.0F, 0.5F})};
  EXPECT_EQ(score_objects(tags, objects).count_error(), 0U);
}

TEST(ObjectScore, TagsOfWhatIsGoneDoNotCount) {
  std::vector<Tag> tags{tag(1, "chair", {1.0F, 2.0F, 0.5F})};
  tags[0].state = TagState::kGone;
  EXPECT_EQ(score_objects(tags, {}).count_error(), 0U);
  EXPECT_EQ(score_objects(tags, {object(1, "chair", {1.0F, 2.0F, 0.5F})}).count_error(), 1U);
}

TEST(ObjectScore, ATagBelongsToATurnedBoxOnlyWhereThatReaches) {
  ExpectedObject shelf = object(1, "bookshelf", {2.0F, 2.0F, 1.0F});
  shelf.box.size_m = {0.3F, 3.0F, 2.0F};
  shelf.box.yaw_rad = static_cast<float>(M_PI / 2.0);  // its long side lies along x
  EXPECT_EQ(
      score_objects(std::vector{tag(1, "bookshelf", {3.4F, 2.0F, 1.0F})}, {shelf}).matches.size(),
      1U);
  EXPECT_TRUE(
      score_objects(std::vector{tag(1, "bookshelf", {2.0F, 3.4F, 1.0F})}, {shelf}).matches.empty());
}

}  // namespace
}  // namespace tsg
