#include "services/tsgctl/map_eval/map_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using testing::HasSubstr;
using testing::Not;

MapEvalReport made_up() {
  MapEvalReport report;
  report.sequence = "data/walking";
  report.poses = "truth";
  report.keyframes = 12;
  report.points = {.measured = 900, .kept = 800, .in_voxels = 300, .stitched = 200, .left = 190};
  report.bytes = {.cloud = 4'800'000, .ot = 900'000, .bt = 100'000};
  report.leaves = 1000;
  report.integration_ms = summarise({10.0, 12.0, 14.0});
  report.traces = TraceScore{.leaves = 1000, .traces = 6, .off_surface = 20};
  report.objects = ObjectScore{
      .classes = {{.class_name = "chair", .objects = 2, .tags = 1, .missing = 1, .surplus = 0}},
      .matches = {{.object_id = 4,
                   .name = "chair_a",
                   .class_name = "chair",
                   .tag_id = 9,
                   .is_well_seen = true,
                   .centre_error_m = 0.034,
                   .size_error = 0.12}}};
  return report;
}

TEST(MapReport, TellsFiguresBesideTheirTargets) {
  const std::string text = to_text(made_up());
  EXPECT_THAT(text, HasSubstr("data/walking, poses of truth, method full"));
  EXPECT_THAT(text, HasSubstr("48.0"));
  EXPECT_THAT(text, HasSubstr("met: at least 47"));
  EXPECT_THAT(text, HasSubstr("6 leaves"));
  EXPECT_THAT(text, HasSubstr("0.60 %"));
  EXPECT_THAT(text, HasSubstr("MISSED: at most 0.50 %"));
  EXPECT_THAT(text, HasSubstr("count error 1"));
  EXPECT_THAT(text, HasSubstr("3.4 cm"));
}

TEST(MapReport, SaysWhereNothingTellsTheTruth) {
  MapEvalReport report = made_up();
  report.traces.reset();
  report.objects.reset();
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("truth_objects.json"));
  EXPECT_THAT(text, HasSubstr("tsgctl simulate"));
  EXPECT_THAT(text, Not(HasSubstr("traces of people  ")));
  const nlohmann::json json = to_json(report);
  EXPECT_TRUE(json.at("traces").is_null());
  EXPECT_TRUE(json.at("objects").is_null());
  EXPECT_EQ(json.at("leaves"), 1000);
}

TEST(MapReport, HasTheSameFiguresInJson) {
  const nlohmann::json json = to_json(made_up());
  EXPECT_EQ(json.at("points").at("left"), 190);
  EXPECT_DOUBLE_EQ(json.at("cloud_to_octree").at("ratio"), 48.0);
  EXPECT_TRUE(json.at("cloud_to_octree").at("met"));
  EXPECT_DOUBLE_EQ(json.at("integration_ms").at("p50"), 12.0);
  EXPECT_DOUBLE_EQ(json.at("traces").at("share"), 0.006);
  EXPECT_FALSE(json.at("traces").at("met"));
  EXPECT_EQ(json.at("objects").at("count_error"), 1);
  EXPECT_EQ(json.at("objects").at("classes").at("chair").at("missing"), 1);
  EXPECT_EQ(json.at("objects").at("matches").at(0).at("tag"), 9);
}

TEST(MapReport, AMapWithoutLeavesHasNoRatio) {
  MapEvalReport report;
  EXPECT_DOUBLE_EQ(to_json(report).at("cloud_to_octree").at("ratio"), 0.0);
}

}  // namespace
}  // namespace tsg
