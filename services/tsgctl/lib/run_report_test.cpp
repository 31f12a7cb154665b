#include "services/tsgctl/lib/run_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/tsgctl/lib/run_summary.hpp"

namespace tsg {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

RunReport complete_report() {
  RunReport report;
  report.version = "0.1.0";
  report.input = "/data/walking_xyz";
  report.out = "/tmp/out";
  report.pace = "lockstep";
  report.segmentation = "dataset";
  report.duration_s = 21.42;
  report.frames_total = 260;
  report.tracking.answered = 260;
  report.tracking.tracked = 258;
  report.tracking.lost = 2;
  report.tracking.with_mask = 130;
  report.tracking.total_ms = {12.5, 20.25};
  report.accuracy = TrajectoryAccuracy{};
  report.accuracy->ate_m = {.count = 258, .rmse = 0.00431, .median = 0.004, .max = 0.0125};
  report.accuracy->rpe_delta = "1 s";
  report.objects = {{"chair", 2}, {"bed", 1}};
  report.processes = {{"slam", 9.5, 210.0, "exit code 0"}};
  report.files = {{"map.bt", 20'000}};
  return report;
}

TEST(RunReport, JsonHoldsWhatWasMeasured) {
  const nlohmann::json json = to_json(complete_report());
  EXPECT_EQ(json["completed"], true);
  EXPECT_EQ(json["problem"], nullptr);
  EXPECT_EQ(json["model"], nullptr);
  EXPECT_EQ(json["frames"]["tracked"], 258);
  EXPECT_DOUBLE_EQ(json["accuracy"]["ate_m"]["rmse"], 0.00431);
  EXPECT_EQ(json["accuracy_live"], nullptr);
  EXPECT_DOUBLE_EQ(json["masks"]["rate"], 0.5);
  EXPECT_DOUBLE_EQ(json["stages_ms"]["total"]["p99"], 20.25);
  EXPECT_DOUBLE_EQ(json["processes"]["slam"]["cpu_s"], 9.5);
  EXPECT_EQ(json["files"][0]["bytes"], 20'000);
  EXPECT_EQ(json["objects"][0]["class"], "chair");
}

TEST(RunReport, JsonTellsWhyARunDidNotComplete) {
  RunReport report = complete_report();
  report.problem = "slam was killed by signal 9 (Killed)";
  const nlohmann::json json = to_json(report);
  EXPECT_EQ(json["completed"], false);
  EXPECT_EQ(json["problem"], report.problem);
}

TEST(RunReport, DroppedAreTheUnansweredThatWereSent) {
  RunReport report = complete_report();
  report.tracking.answered = 250;
  report.frames_late = 3;
  EXPECT_EQ(frames_dropped(report), 7U);
}

TEST(RunReport, FramesThatAnInterruptedRunNeverCameToAreNotDropped) {
  RunReport report = complete_report();
  report.problem = "stopped";
  report.tracking.answered = 100;
  report.tracking.dropped = 2;
  EXPECT_EQ(frames_dropped(report), 2U);
}

TEST(RunReport, ReadsObjectsOfTheMapServersReply) {
  const auto objects =
      objects_of(nlohmann::json::parse(R"({"objects":[{"class":"chair","max_in_view":2}]})"));
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].class_name, "chair");
  EXPECT_EQ(objects[0].count, 2U);
  EXPECT_TRUE(objects_of(nlohmann::json::object()).empty());
}

TEST(RunSummary, ShowsFramesErrorsObjectsAndFiles) {
  const std::string text = summary_text(complete_report());
  EXPECT_THAT(text, HasSubstr("Done"));
  EXPECT_THAT(text, HasSubstr("260 in the input, 258 tracked, 2 lost, 0 dropped"));
  EXPECT_THAT(text, HasSubstr("rmse 0.0043 m, median 0.0040 m, max 0.0125 m over 258 poses"));
  EXPECT_THAT(text, HasSubstr("deg over 1 s"));
  EXPECT_THAT(text, HasSubstr("2 x chair, 1 x bed"));
  EXPECT_THAT(text, HasSubstr("/tmp/out/map.bt (20.0 kB)"));
  EXPECT_THAT(text, HasSubstr("slam         9.5 s CPU, 210 MiB at most"));
}

TEST(RunSummary, SaysSoWhereThereIsNoGroundTruth) {
  RunReport report = complete_report();
  report.accuracy.reset();
  const std::string text = summary_text(report);
  EXPECT_THAT(text, HasSubstr("no ground truth"));
  EXPECT_THAT(text, Not(HasSubstr("ATE")));
}

TEST(RunSummary, IncompleteRunSaysWhy) {
  RunReport report = complete_report();
  report.problem = "interrupted";
  EXPECT_THAT(summary_text(report), HasSubstr("Incomplete: interrupted"));
}

}  // namespace
}  // namespace tsg
