// What stops tsg-camera before it touches the bus, and the bus that is not there: without RouDi.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/component/camera_process.hpp"
#include "tests/support/synthetic_sequence.hpp"

namespace tsg::test {
namespace {

using ::testing::HasSubstr;

class CameraStart : public ::testing::Test {
 protected:
  void SetUp() override { sequence_.write_to(folder_); }

  void expect_exit(const std::vector<std::string>& settings, int code, const std::string& message) {
    CameraProcess camera(folder_.path(), settings);
    EXPECT_EQ(camera.exit_code(), code);
    EXPECT_THAT(camera.log(), HasSubstr(message));
  }

  TempFolder folder_;
  SyntheticSequence sequence_{.frames = 2};
};

TEST_F(CameraStart, WithoutItsFolderNamesIt) {
  expect_exit({"camera.replay.folder=/nowhere/room"}, 66, "there is no folder /nowhere/room");
}

TEST_F(CameraStart, WithoutAListedImageNamesIt) {
  const auto image = folder_ / "rgb" / (sequence_.stamp_text(1) + ".png");
  std::filesystem::remove(image);
  expect_exit({}, 66, "there is no image " + image.string());
}

TEST_F(CameraStart, WithAnEmptyListNamesIt) {
  const auto list = folder_.write("rgb.txt", "# nothing\n");
  expect_exit({}, 67, list.string() + " lists no image");
}

TEST_F(CameraStart, WithADamagedCameraFileNamesFileLineAndKey) {
  const auto file = folder_.write("camera.yaml", sequence_.camera_yaml() + "fz: 1\n");
  expect_exit({}, 65, file.string() + ":17: unknown key \"fz\"");
}

TEST_F(CameraStart, WithoutRouDiSaysSoAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  expect_exit({}, 69, "RouDi");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST_F(CameraStart, WithAnUnknownKeyNamesIt) { expect_exit({"camera.pase=lockstep"}, 78, "pase"); }

TEST_F(CameraStart, WithValuesOutOfRangeListsThemAll) {
  expect_exit({"camera.pace=fast", "camera.read_ahead_frames=8"}, 78,
              "pace must be realtime or lockstep");
  expect_exit({"camera.pace=fast", "camera.read_ahead_frames=8"}, 78,
              "read_ahead_frames must be 1 to 7");
}

TEST_F(CameraStart, WithAnUnknownSceneListsTheOthers) {
  expect_exit({"camera.source=simulation", "camera.simulation.scene=kitchen"}, 66,
              "there is no scene \"kitchen\"; known: busy_office cart corridor_loop crowd");
  expect_exit({"camera.source=simulation", "camera.simulation.scene=/no/room.yaml"}, 66,
              "there is no file /no/room.yaml");
}

TEST_F(CameraStart, WithMistakesInASceneNamesFileLineAndKey) {
  const auto scene = folder_.write("room.yaml", "rooms: []\n");
  expect_exit({"camera.source=simulation", "camera.simulation.scene=" + scene.string()}, 78,
              scene.string() + ":1: rooms: must have at least one");
}

TEST_F(CameraStart, WithoutASceneToSimulateOrWithHalfASizeSaysSo) {
  expect_exit({"camera.source=simulation", "camera.simulation.width=320"}, 78,
              "camera.simulation.scene is not set");
  expect_exit({"camera.source=simulation", "camera.simulation.width=320"}, 78,
              "camera.simulation.width and .height must be 16 to 1280 and 16 to 720, or both 0");
}

TEST_F(CameraStart, WithoutAFolderToReplayAsksForOne) {
  expect_exit({"camera.replay.folder=''"}, 78, "camera.replay.folder is not set");
}

}  // namespace
}  // namespace tsg::test
