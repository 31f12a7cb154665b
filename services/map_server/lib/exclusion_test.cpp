#include "services/map_server/lib/exclusion.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace tsg {
namespace {

/// A wall at 3 m with one instance at 1 m in columns 40..59.
MapKeyframe wall_with(const char* class_name, MotionVerdict motion = MotionVerdict::kUnknown) {
  MapKeyframe keyframe;
  keyframe.frame.depth = cv::Mat1w(60, 100, std::uint16_t{3000});
  keyframe.frame.depth.colRange(40, 60).setTo(1000);
  keyframe.has_labels = true;
  keyframe.instances.labels = cv::Mat1b(60, 100, std::uint8_t{0});
  keyframe.instances.labels.colRange(40, 60).setTo(1);
  keyframe.instances.instances = {{class_name, 1.0F, {}, motion}};
  return keyframe;
}

cv::Mat1b mask_of(const MapKeyframe& keyframe) { return excluded_pixels(keyframe, {}); }

TEST(Exclusion, TakesDynamicClassesOutWithAMargin) {
  const cv::Mat1b mask = mask_of(wall_with("person"));
  EXPECT_EQ(cv::countNonZero(mask.colRange(36, 64)), 60 * 28);  // 4 px on either side
  EXPECT_EQ(cv::countNonZero(mask), 60 * 28);                   // and not a pixel more
}

TEST(Exclusion, KeepsOtherClassesUnlessTheyMove) {
  EXPECT_EQ(cv::countNonZero(mask_of(wall_with("chair"))), 0);
  EXPECT_EQ(cv::countNonZero(mask_of(wall_with("chair", MotionVerdict::kStatic))), 0);
  EXPECT_GT(cv::countNonZero(mask_of(wall_with("chair", MotionVerdict::kMoving))), 0);
}

TEST(Exclusion, TakesADynamicClassOutEvenWhereItStandsStill) {
  EXPECT_GT(cv::countNonZero(mask_of(wall_with("person", MotionVerdict::kStatic))), 0);
}

TEST(Exclusion, FollowsTheBodyBeyondAMaskThatIsTooSmall) {
  MapKeyframe keyframe = wall_with("person");
  keyframe.frame.depth.colRange(60, 70).setTo(1005);  // an arm outside the mask
  const cv::Mat1b mask = mask_of(keyframe);
  EXPECT_EQ(cv::countNonZero(mask.colRange(60, 70)), 60 * 10);
  EXPECT_EQ(cv::countNonZero(mask.colRange(70, 100)), 0);  // the wall is another depth
}

TEST(Exclusion, DoesNotFollowTheDepthWithoutEnd) {
  MapKeyframe keyframe = wall_with("person");
  keyframe.frame.depth.setTo(1000);  // flat against the wall
  const cv::Mat1b mask = mask_of(keyframe);
  EXPECT_EQ(cv::countNonZero(mask.row(30)), 20 + 2 * 15);
}

TEST(Exclusion, LeavesEverythingWithoutLabels) {
  MapKeyframe keyframe = wall_with("person");
  keyframe.has_labels = false;
  const cv::Mat1b mask = mask_of(keyframe);
  EXPECT_EQ(mask.size(), cv::Size(100, 60));
  EXPECT_EQ(cv::countNonZero(mask), 0);
}

}  // namespace
}  // namespace tsg
