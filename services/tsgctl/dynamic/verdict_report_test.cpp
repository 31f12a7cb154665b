#include "services/tsgctl/dynamic/verdict_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

VerdictCounts counts(Judged moving, Judged still) {
  VerdictCounts sum;
  sum.of(TrueState::kMoving) = moving;
  sum.of(TrueState::kStill) = still;
  return sum;
}

/// A walking person, a chair that is pushed and one that stays.
VerdictReport report() {
  FrameScore score{.seq = 3, .stamp_ns = 1'500'000'000, .is_tracked = true};
  score.by_class["person"] = counts({96, 4}, {0, 0});
  score.by_class[kBackground] = counts({0, 0}, {2, 398});
  score.at_edge = counts({10, 10}, {5, 15});
  score.kinds[static_cast<std::size_t>(FeatureKind::kStaticThings)] = {2, 398};
  score.kinds[static_cast<std::size_t>(FeatureKind::kPotentiallyMoving)] = {12, 3};
  score.instances = {{7, "chair", "chair_a", true, {19, 1}},
                     {8, "chair", "chair_b", false, {5, 5}}};
  return {.sequence = "data/moved_chair",
          .method = "tsg",
          .masks = "true masks",
          .margin_px = 2,
          .frames_lost = 1,
          .accuracy = std::nullopt,
          .scores = {score}};
}

TEST(VerdictReportText, ShowsFiguresBesideTheirTargets) {
  const std::string text = to_text(report());
  EXPECT_THAT(text, HasSubstr("data/moved_chair, method tsg, true masks\n"));
  EXPECT_THAT(text,
              HasSubstr("away from edges (2 px)  0.9600       0.9796     96/4    2/398  0/0"));
  EXPECT_THAT(text, HasSubstr("0.97 missed  0.95 met"));
  EXPECT_THAT(text, HasSubstr("with those at edges     0.8833       0.9381     106/14  7/413"));
  EXPECT_THAT(text, HasSubstr("recall by frame: median 0.960, worst 0.960, over 1 frames\n"));
  EXPECT_THAT(text, HasSubstr("frames 1, 1 without a pose\n"));
}

TEST(VerdictReportText, JudgesInstancesByWhetherTheyMove) {
  const std::string text = to_text(report());
  EXPECT_THAT(text, HasSubstr("chair chair_a  7   1         100.0 %, target 95 % met"));
  EXPECT_THAT(text, HasSubstr("1         0.0 %, target 90 % missed"));
}

TEST(VerdictReportText, CountsKindsPerFrame) {
  const std::string text = to_text(report());
  EXPECT_THAT(text, HasSubstr("static things                             400.0     398.0\n"));
  EXPECT_THAT(text, HasSubstr("potentially dynamic, moving               15.0      3.0\n"));
}

TEST(VerdictReportText, SaysWhatIsNotThere) {
  VerdictReport empty = report();
  empty.scores[0].by_class.clear();
  empty.scores[0].instances.clear();
  const std::string text = to_text(empty);
  EXPECT_THAT(text, HasSubstr("recall by frame: no frame has enough features\n"));
  EXPECT_THAT(text, HasSubstr("no instance of a potentially dynamic class was visible\n"));
  EXPECT_THAT(text, HasSubstr("0.97 -"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(VerdictReportText, TellsOfFeaturesOfUnknownTruth) {
  VerdictReport unsure = report();
  EXPECT_THAT(to_text(unsure), Not(HasSubstr("does not tell")));
  unsure.scores[0].by_class["cat"].of(TrueState::kUnknown) = {1, 2};
  EXPECT_THAT(to_text(unsure), HasSubstr("3 features lie on things whose motion"));
}

TEST(VerdictReportJson, HasTheSameFiguresForPrograms) {
  const nlohmann::json json = to_json(report());
  EXPECT_EQ(json["method"], "tsg");
  EXPECT_DOUBLE_EQ(json["total"]["recall"], 0.96);
  EXPECT_EQ(json["with_edges"]["still"]["kept"], 413);
  EXPECT_EQ(json["targets"]["recall"]["met"], false);
  EXPECT_EQ(json["targets"]["precision"]["met"], true);
  EXPECT_EQ(json["classes"]["person"]["moving"]["removed"], 96);
  EXPECT_EQ(json["instances"][0]["removed_share"], 1.0);
  EXPECT_TRUE(json["instances"][0]["kept_share"].is_null());
  EXPECT_DOUBLE_EQ(json["features_per_frame"]["potentially_dynamic_moving"]["left"], 3.0);
  EXPECT_TRUE(json["ate_rmse_m"].is_null());
}

TEST(VerdictReportCsv, HasALineForEachFrame) {
  EXPECT_THAT(to_csv(report().scores),
              HasSubstr("\n3,1.500000,1,0.9600,0.9796,2,398,96,4,0,0,0,0,5,15,10,10,0,0,0,0,398,0,"
                        "3,0,0\n"));
  const std::string heading = to_csv({});
  EXPECT_THAT(heading, HasSubstr("seq,stamp_s,tracked,recall,precision,still_removed,still_kept,"
                                 "moving_removed"));
  EXPECT_EQ(std::count(heading.begin(), heading.end(), ','), 25);
}

}  // namespace
}  // namespace tsg
