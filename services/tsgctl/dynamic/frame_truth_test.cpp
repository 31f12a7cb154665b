#include "services/tsgctl/dynamic/frame_truth.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace tsg {
namespace {

/// A person on the left, then a chair that touches it, then a cup on the ground.
TrueMask scene(MotionVerdict person, MotionVerdict chair, MotionVerdict cup) {
  TrueMask mask;
  mask.segmentation.labels = cv::Mat(40, 80, CV_8UC1, cv::Scalar(0));
  mask.segmentation.labels(cv::Rect(0, 0, 20, 40)) = 1;
  mask.segmentation.labels(cv::Rect(20, 0, 20, 40)) = 2;
  mask.segmentation.labels(cv::Rect(60, 10, 10, 10)) = 3;
  mask.segmentation.instances = {
      {"person", 1.0F, {}, person}, {"chair", 1.0F, {}, chair}, {"cup", 1.0F, {}, cup}};
  mask.ids = {201, 7, 9};
  return mask;
}

const std::map<int, KnownInstance>& known() {
  static const std::map<int, KnownInstance> kKnown{{201, {"person", "ann", true, {}}},
                                                   {7, {"chair", "chair_a", true, {}}},
                                                   {9, {"cup", "", true, {}}}};
  return kKnown;
}

FrameTruth truth_of(const TrueMask& mask, int margin_px = 2) {
  return make_frame_truth(mask, known(), DynamicFilterConfig{}, margin_px);
}

bool is_at_edge(const FrameTruth& truth, int x, int y) {
  return truth.at_edge.at<std::uint8_t>(y, x) != 0;
}

TEST(FrameTruth, TellsWhoIsWho) {
  const FrameTruth truth =
      truth_of(scene(MotionVerdict::kMoving, MotionVerdict::kStatic, MotionVerdict::kUnknown));
  ASSERT_EQ(truth.instances.size(), 3U);
  EXPECT_EQ(truth.instances[0].id, 201);
  EXPECT_EQ(truth.instances[0].name, "ann");
  EXPECT_EQ(truth.instances[0].prior, FeatureVerdict::kDynamic);
  EXPECT_EQ(truth.instances[0].state, TrueState::kMoving);
  EXPECT_EQ(truth.instances[1].prior, FeatureVerdict::kPotentiallyDynamic);
  EXPECT_EQ(truth.instances[1].state, TrueState::kStill);
  EXPECT_EQ(truth.instances[2].prior, FeatureVerdict::kStatic);
  EXPECT_EQ(truth.instances[2].state, TrueState::kUnknown);
}

TEST(FrameTruth, APersonWhoDoesNotMoveIsAtRestAndAChairIsStill) {
  const FrameTruth truth =
      truth_of(scene(MotionVerdict::kStatic, MotionVerdict::kStatic, MotionVerdict::kMoving));
  EXPECT_EQ(truth.instances[0].state, TrueState::kResting);
  EXPECT_EQ(truth.instances[1].state, TrueState::kStill);
  EXPECT_EQ(truth.instances[2].state, TrueState::kMoving);
}

TEST(FrameTruth, EdgesAreWhereTheTruthChangesNotWhereTheNameDoes) {
  const FrameTruth truth =
      truth_of(scene(MotionVerdict::kMoving, MotionVerdict::kStatic, MotionVerdict::kStatic));
  EXPECT_TRUE(is_at_edge(truth, 18, 20));  // person, two columns from the chair
  EXPECT_TRUE(is_at_edge(truth, 21, 20));  // chair, two columns from the person
  EXPECT_FALSE(is_at_edge(truth, 17, 20));
  EXPECT_FALSE(is_at_edge(truth, 22, 20));
  EXPECT_FALSE(is_at_edge(truth, 40, 20));  // a chair that stays, and the ground
  EXPECT_FALSE(is_at_edge(truth, 60, 15));
}

TEST(FrameTruth, WithoutMarginThereAreNoEdges) {
  const TrueMask mask =
      scene(MotionVerdict::kMoving, MotionVerdict::kMoving, MotionVerdict::kMoving);
  EXPECT_GT(cv::countNonZero(truth_of(mask, 1).at_edge), 0);
  EXPECT_EQ(cv::countNonZero(truth_of(mask, 0).at_edge), 0);
}

}  // namespace
}  // namespace tsg
