// The main job through `tsgctl run`, judged by what it writes: the figures of docs/evaluation.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/e2e/tsgctl_run.hpp"
#include "tests/support/shared_dir.hpp"

namespace tsg::test {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kFiles{
    "trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ot", "map.bt", "cloud.ply"};

std::vector<std::string> lockstep(const std::string& segmentation) {
  return {"--pace", "lockstep", "--segmentation", segmentation};
}

/// Runs and checks what every complete run owes; its report.
nlohmann::json complete_run(TsgctlRun& run) {
  const ProgramResult result = run.run();
  EXPECT_EQ(result.end.exit_code, 0) << result.output;
  const nlohmann::json report = run.report();
  if (!report.is_object()) {
    ADD_FAILURE() << "no report.json:\n" << result.output;
    return {};
  }
  EXPECT_EQ(report["completed"], true);
  for (const std::string& file : kFiles) {
    EXPECT_GT(std::filesystem::file_size(run.out() / file), 0U) << file;
    EXPECT_THAT(result.output, HasSubstr(file));
  }
  return report;
}

void expect_all_tracked(const nlohmann::json& report) {
  EXPECT_EQ(report["frames"]["tracked"], report["frames"]["total"]);
  EXPECT_EQ(report["frames"]["lost"], 0);
  EXPECT_EQ(report["frames"]["dropped"], 0);
}

double ate_rmse(const nlohmann::json& report) { return report["accuracy"]["ate_m"]["rmse"]; }

TEST(RunSimulatedRoom, TracksEveryFrameAndReportsAllThatItOwes) {
  TsgctlRun run(simulated_room(), lockstep("dataset"));
  const nlohmann::json report = complete_run(run);
  ASSERT_TRUE(report.is_object());
  expect_all_tracked(report);
  EXPECT_LE(ate_rmse(report), 0.02);
  EXPECT_GT(report["accuracy_live"]["ate_m"]["count"], 0);
  EXPECT_GT(report["stages_ms"]["total"]["p99"], 0.0);
  EXPECT_GT(report["latency_ms"]["p50"], 0.0);
  EXPECT_DOUBLE_EQ(report["masks"]["rate"], 1.0);
  EXPECT_FALSE(report["objects"].empty());
  for (const char* service : {"camera", "segmentation", "slam", "map_server"}) {
    EXPECT_GT(report["processes"][service]["peak_rss_mib"], 1.0) << service;
    EXPECT_EQ(report["processes"][service]["end"], "exit code 0") << service;
  }
}

TEST(RunSimulatedRoom, TwoLockstepRunsGiveTheSameTrajectoryToTheByte) {
  TsgctlRun first(simulated_room(), lockstep("dataset"));
  TsgctlRun second(simulated_room(), lockstep("dataset"));
  (void)complete_run(first);
  (void)complete_run(second);
  const std::string trajectory = test::content_of(first.out() / "trajectory.txt");
  EXPECT_FALSE(trajectory.empty());
  EXPECT_EQ(trajectory, test::content_of(second.out() / "trajectory.txt"));
}

TEST(RunWalkingXyz, LockstepWithTrueMasksIsAccurate) {
  TSG_REQUIRE_SHARED("data/rendered/walking_xyz");
  TsgctlRun run(shared_dir() / "data/rendered/walking_xyz", lockstep("dataset"));
  const nlohmann::json report = complete_run(run);
  ASSERT_TRUE(report.is_object());
  expect_all_tracked(report);
  EXPECT_LE(ate_rmse(report), 0.02);
}

TEST(RunWalkingXyz, WithoutSegmentationTheErrorIsReportedWhateverItIs) {
  TSG_REQUIRE_SHARED("data/rendered/walking_xyz");
  TsgctlRun run(shared_dir() / "data/rendered/walking_xyz", lockstep("off"));
  const nlohmann::json report = complete_run(run);
  ASSERT_TRUE(report.is_object());
  EXPECT_GT(ate_rmse(report), 0.0);
  EXPECT_EQ(report["segmentation"], "off");
  EXPECT_FALSE(report["processes"].contains("segmentation"));
}

TEST(RunWalkingXyz, NetworkInRealTimeDropsNoFrame) {
  TSG_REQUIRE_SHARED("data/rendered/walking_xyz");
  TSG_REQUIRE_SHARED("models/yolov8n-seg/model.onnx");
  TsgctlRun run(shared_dir() / "data/rendered/walking_xyz",
                {"--pace", "realtime", "--segmentation", "model", "--model",
                 (shared_dir() / "models/yolov8n-seg/model.onnx").string()});
  const nlohmann::json report = complete_run(run);
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["frames"]["dropped"], 0);
  EXPECT_LE(ate_rmse(report), 0.05);
}

TEST(RunStaticRoom, LockstepWithTrueMasksIsAccurate) {
  TSG_REQUIRE_SHARED("data/rendered/static_room");
  TsgctlRun run(shared_dir() / "data/rendered/static_room", lockstep("dataset"));
  const nlohmann::json report = complete_run(run);
  ASSERT_TRUE(report.is_object());
  expect_all_tracked(report);
  EXPECT_LE(ate_rmse(report), 0.015);
}

TEST(RunFr1Desk, RealKinectImagesAreAllTracked) {
  TSG_REQUIRE_SHARED("data/tum_bits/fr1_desk_9");
  TsgctlRun run(shared_dir() / "data/tum_bits/fr1_desk_9", lockstep("off"));
  const nlohmann::json report = complete_run(run);
  ASSERT_TRUE(report.is_object());
  expect_all_tracked(report);
  EXPECT_LE(ate_rmse(report), 0.01);
}

}  // namespace
}  // namespace tsg::test
