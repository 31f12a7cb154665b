#include "services/tsgctl/dynamic/verdict_score.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace tsg {
namespace {

/// Ten columns for each instance, left to right, then ground. The last row is at an edge.
FrameTruth truth_with(std::vector<TrueInstance> instances) {
  FrameTruth truth;
  truth.labels = cv::Mat(20, 100, CV_8UC1, cv::Scalar(0));
  truth.at_edge = cv::Mat(20, 100, CV_8UC1, cv::Scalar(0));
  truth.at_edge.row(19) = 255;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    truth.labels.colRange(10 * static_cast<int>(i), 10 * static_cast<int>(i) + 10) =
        static_cast<double>(i + 1);
  }
  truth.instances = std::move(instances);
  return truth;
}

/// `removed` and `kept` features on the instance of that index; at an edge where `at_edge`.
void add_features(FrameVerdicts& verdicts, int index, int removed, int kept, bool at_edge = false) {
  for (int i = 0; i < removed + kept; ++i) {
    verdicts.features.push_back({.raw_x = static_cast<std::int16_t>(10 * index + i % 10),
                                 .raw_y = static_cast<std::int16_t>(at_edge ? 19 : i % 19),
                                 .is_dynamic = i < removed});
  }
}

const TrueInstance kWalker{201, "person", "ann", FeatureVerdict::kDynamic, TrueState::kMoving};
const TrueInstance kSitter{202, "person", "bob", FeatureVerdict::kDynamic, TrueState::kResting};
const TrueInstance kPushed{7, "chair", "a", FeatureVerdict::kPotentiallyDynamic,
                           TrueState::kMoving};
const TrueInstance kLeft{8, "chair", "b", FeatureVerdict::kPotentiallyDynamic, TrueState::kStill};
const TrueInstance kCart{9, "", "cart", FeatureVerdict::kStatic, TrueState::kMoving};
const TrueInstance kOdd{10, "chair", "c", FeatureVerdict::kPotentiallyDynamic, TrueState::kUnknown};
constexpr int kNothing = 9;  // as an index: its columns belong to no instance here

const InstanceTally* find(const VerdictSummary& summary, int id) {
  for (const InstanceTally& tally : summary.instances) {
    if (tally.id == id) return &tally;
  }
  return nullptr;
}

Judged kind(const FrameScore& score, FeatureKind of) {
  return score.kinds[static_cast<std::size_t>(of)];
}

TEST(VerdictScore, RecallAndPrecisionLeaveOutWhoRests) {
  FrameVerdicts verdicts;
  add_features(verdicts, 0, 9, 1);    // walks
  add_features(verdicts, 1, 50, 30);  // rests
  add_features(verdicts, kNothing, 3, 97);
  const VerdictCounts counts =
      score_frame(verdicts, truth_with({kWalker, kSitter})).away_from_edges();
  EXPECT_DOUBLE_EQ(*counts.recall(), 0.9);
  EXPECT_DOUBLE_EQ(*counts.precision(), 9.0 / 12.0);
  EXPECT_EQ(counts.of(TrueState::kResting), (Judged{50, 30}));
}

TEST(VerdictScore, WithoutAnythingToJudgeThereIsNoFigure) {
  FrameVerdicts verdicts;
  add_features(verdicts, kNothing, 0, 10);
  const VerdictCounts counts = score_frame(verdicts, truth_with({})).away_from_edges();
  EXPECT_FALSE(counts.recall());
  EXPECT_FALSE(counts.precision());
  EXPECT_EQ(counts.of(TrueState::kStill), (Judged{0, 10}));
}

TEST(VerdictScore, FeaturesAtEdgesCountApartAndComeBackInTheSecondTotal) {
  FrameVerdicts verdicts;
  add_features(verdicts, 0, 10, 0);
  add_features(verdicts, 0, 0, 10, /*at_edge=*/true);
  add_features(verdicts, kNothing, 5, 0, /*at_edge=*/true);
  const VerdictSummary summary = summarise({score_frame(verdicts, truth_with({kWalker}))});
  EXPECT_DOUBLE_EQ(*summary.total.recall(), 1.0);
  EXPECT_DOUBLE_EQ(*summary.total.precision(), 1.0);
  EXPECT_DOUBLE_EQ(*summary.with_edges().recall(), 0.5);
  EXPECT_DOUBLE_EQ(*summary.with_edges().precision(), 10.0 / 15.0);
}

TEST(VerdictScore, WhatIsNotKnownToMoveIsInNeitherFigureNorTable) {
  FrameVerdicts verdicts;
  add_features(verdicts, 0, 10, 10);
  const FrameScore score = score_frame(verdicts, truth_with({kOdd}));
  EXPECT_FALSE(score.away_from_edges().recall());
  EXPECT_FALSE(score.away_from_edges().precision());
  EXPECT_EQ(score.away_from_edges().of(TrueState::kUnknown), (Judged{10, 10}));
  EXPECT_TRUE(score.instances.empty());
  for (const Judged& counted : score.kinds) EXPECT_EQ(counted.total(), 0U);
}

TEST(VerdictScore, IsSplitByTheTrueClass) {
  FrameVerdicts verdicts;
  add_features(verdicts, 0, 4, 0);
  add_features(verdicts, 1, 1, 2);
  add_features(verdicts, 2, 0, 7);
  add_features(verdicts, kNothing, 1, 5);
  const FrameScore score = score_frame(verdicts, truth_with({kWalker, kPushed, kLeft}));
  ASSERT_EQ(score.by_class.size(), 3U);
  EXPECT_EQ(score.by_class.at("person").of(TrueState::kMoving), (Judged{4, 0}));
  EXPECT_EQ(score.by_class.at("chair").of(TrueState::kMoving), (Judged{1, 2}));
  EXPECT_EQ(score.by_class.at("chair").of(TrueState::kStill), (Judged{0, 7}));
  EXPECT_EQ(score.by_class.at(kBackground).of(TrueState::kStill), (Judged{1, 5}));
}

TEST(VerdictScore, CountsKindsAsThePaperDoesWithThoseAtEdges) {
  FrameVerdicts verdicts;
  add_features(verdicts, 0, 3, 1);
  add_features(verdicts, 1, 2, 2, /*at_edge=*/true);
  add_features(verdicts, 2, 5, 6);
  add_features(verdicts, 3, 0, 7);
  add_features(verdicts, 4, 1, 8);
  add_features(verdicts, kNothing, 2, 50);
  const FrameScore score =
      score_frame(verdicts, truth_with({kWalker, kSitter, kPushed, kLeft, kCart}));
  EXPECT_EQ(kind(score, FeatureKind::kDynamicClasses), (Judged{5, 3}));
  EXPECT_EQ(kind(score, FeatureKind::kPotentiallyMoving), (Judged{5, 6}));
  EXPECT_EQ(kind(score, FeatureKind::kPotentiallyStill), (Judged{0, 7}));
  EXPECT_EQ(kind(score, FeatureKind::kUnexpectedlyMoving), (Judged{1, 8}));
  EXPECT_EQ(kind(score, FeatureKind::kStaticThings), (Judged{2, 50}));
}

/// A frame in which a chair has so many features.
FrameScore frame_with(const TrueInstance& chair, int removed, int kept) {
  FrameVerdicts verdicts;
  add_features(verdicts, 0, removed, kept);
  return score_frame(verdicts, truth_with({chair}));
}

TEST(VerdictSummary, AnInstanceIsRemovedFromFourFifthsOfItsFeaturesOn) {
  const VerdictSummary summary = summarise({frame_with(kPushed, 8, 2),    // removed
                                            frame_with(kPushed, 7, 3),    // not
                                            frame_with(kPushed, 4, 0),    // too few to be seen
                                            frame_with(kPushed, 5, 0)});  // removed
  const InstanceTally* chair = find(summary, kPushed.id);
  ASSERT_NE(chair, nullptr);
  EXPECT_EQ(chair->frames_moving, 3U);
  EXPECT_EQ(chair->frames_removed, 2U);
  EXPECT_DOUBLE_EQ(*chair->removed_share(), 2.0 / 3.0);
  EXPECT_FALSE(chair->kept_share());
}

TEST(VerdictSummary, AnInstanceIsKeptFromFourFifthsOfItsFeaturesOn) {
  TrueInstance stopped = kPushed;
  stopped.state = TrueState::kStill;
  const VerdictSummary summary =
      summarise({frame_with(kPushed, 10, 0), frame_with(stopped, 2, 8), frame_with(stopped, 3, 7)});
  const InstanceTally* chair = find(summary, kPushed.id);
  ASSERT_NE(chair, nullptr);
  EXPECT_DOUBLE_EQ(*chair->removed_share(), 1.0);
  EXPECT_EQ(chair->frames_still, 2U);
  EXPECT_DOUBLE_EQ(*chair->kept_share(), 0.5);
}

TEST(VerdictSummary, PeopleAreNoInstancesOfInterestButCartsThatMoveAre) {
  FrameVerdicts verdicts;
  add_features(verdicts, 0, 10, 0);
  add_features(verdicts, 1, 10, 0);
  add_features(verdicts, 2, 0, 10);
  const VerdictSummary summary =
      summarise({score_frame(verdicts, truth_with({kWalker, kSitter, kCart}))});
  ASSERT_EQ(summary.instances.size(), 1U);
  EXPECT_EQ(summary.instances[0].name, "cart");
  EXPECT_DOUBLE_EQ(*summary.instances[0].removed_share(), 0.0);
}

TEST(VerdictSummary, MedianAndWorstAreOverFramesWithEnoughFeatures) {
  const VerdictSummary summary = summarise({frame_with(kPushed, 10, 0), frame_with(kPushed, 9, 1),
                                            frame_with(kPushed, 2, 8), frame_with(kPushed, 0, 4)});
  EXPECT_EQ(summary.frames, 4U);
  EXPECT_EQ(summary.recall.frames, 3U);
  EXPECT_DOUBLE_EQ(summary.recall.median, 0.9);
  EXPECT_DOUBLE_EQ(summary.recall.worst, 0.2);
  EXPECT_EQ(summary.precision.frames, 2U);  // the third removed two features only
  EXPECT_DOUBLE_EQ(summary.precision.worst, 1.0);
  EXPECT_DOUBLE_EQ(*summary.total.recall(), 21.0 / 34.0);
}

}  // namespace
}  // namespace tsg
