// Maps of slam in files, as users handle them: tsg-slam and tsgctl in processes of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/bus/command.hpp"
#include "common/bus/diagnostics.hpp"
#include "common/dataset/trajectory.hpp"
#include "common/map_file/map_file.hpp"
#include "tests/component/slam_service.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/wait.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;

class SlamMaps : public SlamService {
 protected:
  void start_slam(const std::vector<std::string>& more = {}) {
    std::vector<std::string> settings = {"slam.lockstep=true", "slam.expect_masks=false"};
    settings.insert(settings.end(), more.begin(), more.end());
    start(settings);
  }
  void start_in_map(const std::filesystem::path& map, const std::vector<std::string>& more = {}) {
    std::vector<std::string> settings = {"slam.map.load=" + map.string()};
    settings.insert(settings.end(), more.begin(), more.end());
    start_slam(settings);
  }

  /// Walks along the wall and saves what was mapped.
  void save_a_map() {
    start_slam();
    for (std::uint64_t seq = 0; seq < 25; ++seq) {
      ASSERT_EQ(track(frame_at(0.02 * static_cast<double>(seq))), tsg_TRACKING_OK)
          << content_of(log_);
    }
    const ProgramResult saved = tsgctl({"map", "save", map_.string()});
    ASSERT_EQ(saved.end.exit_code, 0) << saved.output;
    EXPECT_THAT(saved.output, AllOf(HasSubstr("saved"), HasSubstr("home.tsgmap")));
  }
  /// Ends slam and waits until the bus has noticed.
  void end_slam() {
    EXPECT_TRUE(stop().is_success()) << content_of(log_);
    EXPECT_TRUE(eventually(kPatience,
                           [&] { return bus_.publisher<topics::Rgbd>().subscriber_count() == 0; }));
  }

  RgbdFrame frame_at(double x_m) { return wall_.frame(seq_++, x_m, 0.0); }

  /// Shows slam the wall from a place until it has a pose there; y of it in `map`.
  std::optional<double> find_place(double x_m) {
    auto& poses = bus_.subscriber<topics::Pose>();
    EXPECT_TRUE(poses.wait_for_publishers(1, kPatience)) << content_of(log_);
    for (int i = 0; i < 10; ++i) {
      if (track(frame_at(x_m)) != tsg_TRACKING_OK) continue;
      const auto pose = poses.take({}, kPatience);
      if (pose) return (*pose)->pose.position.y;
    }
    return std::nullopt;
  }

  static ProgramResult tsgctl(const std::vector<std::string>& arguments) {
    return run_program(TSG_BIN_DIR "/tsgctl", arguments);
  }
  static nlohmann::json tsgctl_json(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const ProgramResult result = tsgctl(arguments);
    EXPECT_EQ(result.end.exit_code, 0) << result.output;
    return nlohmann::json::parse(result.output, nullptr, /*allow_exceptions=*/false);
  }

  std::filesystem::path map_ = folder_ / "home.tsgmap";
  std::uint64_t seq_ = 0;
};

TEST_F(SlamMaps, AreTheFrameOfThePosesAfterARestartAndStayAsTheyAre) {
  save_a_map();
  const nlohmann::json of_file = tsgctl_json({"map", "info", map_.string()});
  end_slam();
  start_in_map(map_, {"slam.map.localisation_only=true"});
  auto y_m = find_place(0.30);
  ASSERT_TRUE(y_m) << content_of(log_);
  EXPECT_NEAR(*y_m, -0.30, 0.005) << "right of where the map began is -y of it";
  for (int i = 0; i < 30; ++i) {  // to the end of the map and beyond
    ASSERT_EQ(track(frame_at(0.30 + 0.01 * i)), tsg_TRACKING_OK) << "step " << i;
  }
  const nlohmann::json now = tsgctl_json({"map", "info"});
  EXPECT_EQ(now["keyframes"], of_file["keyframes"]);
  EXPECT_EQ(now["points"], of_file["points"]);
  EXPECT_EQ(now["localisation_only"], true);
  EXPECT_EQ(now["loaded_from"], map_.string());
}

TEST_F(SlamMaps, SayThatThePlaceIsLookedForUntilItIsFound) {
  save_a_map();
  end_slam();
  start_in_map(map_, {"slam.map.localisation_only=true"});
  RgbdFrame blank = frame_at(0.0);
  blank.colour.setTo(0);
  blank.depth.setTo(0);
  const auto status = answer_to(blank);
  ASSERT_TRUE(status) << content_of(log_);
  EXPECT_EQ((*status)->state, tsg_TRACKING_LOST);
  EXPECT_THAT((*status)->reason, HasSubstr("looking for the place in the loaded map"));
  const auto diagnostics = bus_.wait_for<topics::Diagnostics>(kPatience, [](const auto& message) {
    const auto heard = to_diagnostics(message);
    return !heard.empty() && heard.front().diagnostic.message == "lost (localisation only)";
  });
  EXPECT_TRUE(diagnostics);
}

TEST_F(SlamMaps, GrowWhereLocalisationIsNotAll) {
  save_a_map();
  const auto before = tsgctl_json({"map", "info"})["keyframes"].get<int>();
  end_slam();
  start_in_map(map_);
  ASSERT_TRUE(find_place(0.40)) << content_of(log_);
  for (int i = 0; i < 30; ++i) {
    ASSERT_EQ(track(frame_at(0.40 + 0.02 * i)), tsg_TRACKING_OK) << "step " << i;
  }
  EXPECT_GT(tsgctl_json({"map", "info"})["keyframes"].get<int>(), before);
  CommandClient client(bus_.bus());
  const std::string argument = nlohmann::json{{"folder", (folder_ / "out").string()}}.dump();
  ASSERT_TRUE(client.call("slam", "save_trajectory", argument, kPatience));
  const auto keyframes = read_trajectory(folder_ / "out" / "keyframes.txt");
  ASSERT_TRUE(keyframes) << keyframes.error().message;
  EXPECT_GT(keyframes->front().stamp_ns, wall_.frame(24, 0.0, 0.0).stamp_ns)
      << "those that came with the map belong to another run";
}

TEST_F(SlamMaps, CanBeChangedWhileSlamRuns) {
  save_a_map();
  end_slam();
  start_slam();
  ASSERT_EQ(track(frame_at(0.40)), tsg_TRACKING_OK) << content_of(log_);
  ASSERT_EQ(track(frame_at(0.40)), tsg_TRACKING_OK) << "here is the origin of a map of its own";
  const ProgramResult loaded = tsgctl({"map", "load", map_.string(), "--localisation-only"});
  ASSERT_EQ(loaded.end.exit_code, 0) << loaded.output;
  EXPECT_THAT(loaded.output, AllOf(HasSubstr("home.tsgmap"), HasSubstr("localisation only")));
  while (bus_.subscriber<topics::Pose>().take({}, 100ms)) {
  }
  const auto y_m = find_place(0.30);
  ASSERT_TRUE(y_m) << content_of(log_);
  EXPECT_NEAR(*y_m, -0.30, 0.005);
}

TEST_F(SlamMaps, ThatCannotBeLoadedLeaveARunningSlamAsItWas) {
  save_a_map();
  folder_.write("damaged.tsgmap", content_of(map_).substr(0, 5000));
  const ProgramResult damaged = tsgctl({"map", "load", (folder_ / "damaged.tsgmap").string()});
  EXPECT_EQ(damaged.end.exit_code, code(ExitCode::kBadData));
  EXPECT_THAT(damaged.output, AllOf(HasSubstr("damaged.tsgmap"), HasSubstr("is damaged")));
  MapFile file = value_or_throw(read_map_file(map_));
  file.info.camera.fx += 1.0;
  ASSERT_TRUE(write_map_file(folder_ / "other.tsgmap", file.info, file.map()));
  const ProgramResult other = tsgctl({"map", "load", (folder_ / "other.tsgmap").string()});
  EXPECT_EQ(other.end.exit_code, code(ExitCode::kConfig));
  EXPECT_THAT(other.output, AllOf(HasSubstr("fx 501"), HasSubstr("fx 500")));
  EXPECT_EQ(track(frame_at(0.48)), tsg_TRACKING_OK);
  EXPECT_EQ(tsgctl_json({"map", "info"})["loaded_from"], "");
}

TEST_F(SlamMaps, ThatCannotBeSavedAreToldOf) {
  start_slam();
  const ProgramResult none = tsgctl({"map", "save", map_.string()});
  EXPECT_EQ(none.end.exit_code, code(ExitCode::kEmptyInput)) << none.output;
  ASSERT_EQ(track(frame_at(0.0)), tsg_TRACKING_OK) << content_of(log_);
  const ProgramResult nowhere = tsgctl({"map", "save", (folder_ / "absent" / "x").string()});
  EXPECT_EQ(nowhere.end.exit_code, code(ExitCode::kCannotWrite));
  EXPECT_THAT(nowhere.output, HasSubstr("create the folder first"));
  const ProgramResult full = tsgctl({"map", "save", "/dev/full"});
  EXPECT_EQ(full.end.exit_code, code(ExitCode::kCannotWrite));
  EXPECT_THAT(full.output, HasSubstr("No space left on device"));
}

TEST_F(SlamMaps, ThatSlamCannotStartInEndIt) {
  save_a_map();
  end_slam();
  std::string bytes = content_of(map_);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  start_in_map(folder_.write("damaged.tsgmap", bytes));
  EXPECT_EQ(wait_for_end().exit_code, code(ExitCode::kBadData));
  EXPECT_THAT(content_of(log_), HasSubstr("does not match its checksum"));
  start_in_map(folder_ / "absent.tsgmap");
  EXPECT_EQ(wait_for_end().exit_code, code(ExitCode::kMissingInput));
  EXPECT_THAT(content_of(log_), HasSubstr("absent.tsgmap"));
  start_slam({"slam.map.localisation_only=true"});
  EXPECT_EQ(wait_for_end().exit_code, code(ExitCode::kConfig));
  EXPECT_THAT(content_of(log_), HasSubstr("set map.load"));
}

TEST_F(SlamMaps, OfAnotherCameraEndSlamAtTheFirstFrame) {
  save_a_map();
  end_slam();
  start_in_map(map_);
  RgbdFrame other = frame_at(0.0);
  other.camera.fx = 510.25;
  const auto ended = end_of(other);
  ASSERT_TRUE(ended) << content_of(log_);
  EXPECT_EQ(ended->exit_code, code(ExitCode::kConfig));
  EXPECT_THAT(content_of(log_), AllOf(HasSubstr("fx 500 "), HasSubstr("fx 510.25 ")));
}

TEST_F(SlamMaps, AreExaminedWithoutASystem) {
  const ProgramResult absent = tsgctl({"map", "info", (folder_ / "absent.tsgmap").string()});
  EXPECT_EQ(absent.end.exit_code, code(ExitCode::kMissingInput));
  const ProgramResult other = tsgctl({"map", "info", folder_.write("a.txt", "text").string()});
  EXPECT_EQ(other.end.exit_code, code(ExitCode::kBadData));
  EXPECT_THAT(other.output, HasSubstr("is no map file"));
  const ProgramResult silent = tsgctl({"map", "info", "--timeout", "0.3"});
  EXPECT_EQ(silent.end.exit_code, code(ExitCode::kTimeout));
  const ProgramResult nothing = tsgctl({"map"});
  EXPECT_EQ(nothing.end.exit_code, code(ExitCode::kUsage));
}

}  // namespace
}  // namespace tsg::test
