// The main job through `tsgctl run`, judged by what it writes: the figures of docs/evaluation.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/e2e/tsgctl_run.hpp"
#include "tests/support/shared_dir.hpp"

namespace tsg::test {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kFiles{
    "trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ot",
    "map.bt",         "cloud.ply",           "map.png",       "trajectory.png"};

std::vector<std::string> lockstep(const std::string& segmentation) {
  return {"--pace", "lockstep", "--segmentation", segmentation};
}

/// Runs and checks what every complete run owes; its report.
nlohmann::json complete_run(TsgctlRun& run) {
  const ProgramResult result = run.run();
  EXPECT_EQ(result.end.exit_code, 0) << result.output;
  nlohmann::json report = run.report();
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

TEST(RunSimulatedRoom, DrawsWhatWasJudgedOnRequest) {
  std::vector<std::string> options = lockstep("dataset");
  options.insert(options.end(), {"--debug", "--method", "mask"});
  TsgctlRun run(simulated_room(), options);
  const auto old = run.out() / "debug" / "000777.png";
  std::filesystem::create_directories(old.parent_path());
  std::ofstream(old) << "of an earlier run";
  complete_run(run);
  for (const char* name : {"000000.png", "000010.png", "000020.png", "000030.png"}) {
    EXPECT_THAT(test::content_of(run.out() / "debug" / name), HasSubstr("PNG")) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(run.out() / "debug" / "000001.png"));
  EXPECT_FALSE(std::filesystem::exists(old));
}

TEST(RunSimulatedRoom, SavesAMapAndFindsItsWayInItTheNextTime) {
  const TempFolder maps;
  const std::string map = (maps / "room.tsgmap").string();
  std::vector<std::string> options = lockstep("dataset");
  options.insert(options.end(), {"--save-map", map});
  TsgctlRun first(simulated_room(), options);
  const nlohmann::json saved = complete_run(first)["services"]["slam"]["saved_map"];
  EXPECT_EQ(saved["bytes"], std::filesystem::file_size(map));
  options = lockstep("dataset");
  options.insert(options.end(), {"--load-map", map, "--localisation-only"});
  TsgctlRun second(simulated_room(), options);
  const ProgramResult result = second.run();
  EXPECT_EQ(result.end.exit_code, 0) << result.output;
  const nlohmann::json report = second.report();
  ASSERT_TRUE(report.is_object()) << result.output;
  EXPECT_LE(report["frames"]["lost"], 1) << "the first frame has to be recognised";
  EXPECT_LE(ate_rmse(report), 0.02);
  EXPECT_EQ(report["services"]["slam"]["keyframes_sent"], 0) << "the map stays as it is";
}

TEST(RunSimulatedRoom, FolderForTheMapIsMissedBeforeAnythingStarts) {
  TsgctlRun run(simulated_room(), {"--save-map", "/nonexistent/room.tsgmap"});
  const ProgramResult result = run.run();
  EXPECT_EQ(result.end.exit_code, static_cast<int>(ExitCode::kCannotWrite));
  EXPECT_THAT(result.output, HasSubstr("--save-map /nonexistent/room.tsgmap"));
  EXPECT_FALSE(std::filesystem::exists(run.out()));
}

constexpr const char* kCachedScene = TSG_SOURCE_DIR "/deploy/cached-scene";
constexpr const char* kTsgctl = TSG_BIN_DIR "/tsgctl";

/// What deploy/quickstart does about its input.
ProgramResult cached_scene(const std::filesystem::path& cache, const std::string& scene) {
  return run_program(
      "/usr/bin/env",
      {"XDG_CACHE_HOME=" + cache.string(), kCachedScene, kTsgctl, scene, "--frames", "3"},
      kRunTimeout);
}

std::filesystem::path last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n') + 1;
  return text.substr(0, end).substr(text.rfind('\n', end - 1) + 1);
}

TEST(CachedScene, IsRenderedOnceAndAnewWhenTheSceneChanges) {
  const TempFolder temp;
  const std::string text =
      "rooms: [{min_m: [0, 0], max_m: [4, 3]}]\nsensor: {width: 64, height: 48}\n"
      "camera: {waypoints: [{at_s: 0, position_m: [1, 1, 1.4], look_at_m: [3, 1.5, 1.2]}]}\n";
  const std::string scene = temp.write("room.yaml", text).string();
  const ProgramResult first = cached_scene(temp / "cache", scene);
  ASSERT_EQ(first.end.exit_code, 0) << first.output;
  const std::filesystem::path folder = last_line(first.output);
  ASSERT_TRUE(std::filesystem::exists(folder / "rgb.txt")) << first.output;

  const ProgramResult second = cached_scene(temp / "cache", scene);
  EXPECT_EQ(second.output, folder.string() + "\n") << "nothing is rendered again";

  temp.write("room.yaml", text + "seed: 2\n");
  const ProgramResult third = cached_scene(temp / "cache", scene);
  EXPECT_NE(last_line(third.output), folder);
  EXPECT_FALSE(std::filesystem::exists(folder)) << "the old one takes room";
}

TEST(CachedScene, LeavesNothingWhereRenderingFails) {
  const TempFolder temp;
  const std::string scene = temp.write("room.yaml", "rooms: []\n").string();
  const ProgramResult result = cached_scene(temp / "cache", scene);
  EXPECT_EQ(result.end.exit_code, static_cast<int>(ExitCode::kConfig));
  EXPECT_THAT(result.output, HasSubstr("room.yaml:1: rooms: must have at least one"));
  EXPECT_TRUE(std::filesystem::is_empty(temp / "cache/tsg-slam"));
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

/// Where people cover half of what is seen, so that poses are off by decimetres if nothing tells
/// which pixels they are.
TEST(RunBusyOffice, TheShippedNetworkKeepsPeopleOutOfThePoses) {
  const TempFolder folder;
  simulate(folder / "office", "busy_office", {"--frames", "330", "--size", "320x240"});
  const auto options_with = [](const std::string& segmentation) {
    std::vector<std::string> options = lockstep(segmentation);
    options.insert(options.end(), {"--method", "mask"});
    return options;
  };
  TsgctlRun blind(folder / "office", options_with("off"));
  const nlohmann::json without = complete_run(blind);
  ASSERT_TRUE(without.is_object());
  EXPECT_GT(ate_rmse(without), 0.1) << "the scene is too easy to tell anything";

  TsgctlRun run(folder / "office", options_with("model"));
  const nlohmann::json report = complete_run(run);
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["frames"]["dropped"], 0);
  EXPECT_GE(report["frames"]["tracked"], 325) << "of 330";
  EXPECT_EQ(std::filesystem::path(report["model"].get<std::string>()).filename(),
            "solov2-rooms.onnx");
  EXPECT_DOUBLE_EQ(report["masks"]["rate"], 1.0);
  EXPECT_LE(ate_rmse(report), 0.03);
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
