#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "common/scene_file/scene_file_fixture.hpp"

namespace tsg {
namespace {

using simulation::ActionKind;
using simulation::SceneDescription;
using ::testing::ElementsAre;

TEST_F(SceneFile, WithRoomAndCameraIsEnoughAndTakesItsNameFromTheFile) {
  const SceneDescription scene = scene_with("");
  EXPECT_EQ(scene.name, "room");
  ASSERT_EQ(scene.rooms.size(), 1U);
  EXPECT_EQ(scene.rooms[0].max_m, Eigen::Vector2d(6.0, 5.0));
  EXPECT_EQ(scene.rooms[0].name, "room_1");
  EXPECT_EQ(scene.camera.waypoints.at(0).look_at_m, Eigen::Vector3d(3.0, 3.0, 1.0));
}

TEST_F(SceneFile, ReadsEveryKeyOfTheBuilding) {
  const auto scene = load(R"(name: flat
description: two rooms
duration_s: 12.5
seed: 18446744073709551615
rooms:
  - {name: hall, min_m: [0, 0], max_m: [6, 5], height_m: 3, floor: carpet, walls: plaster,
     wall_colour_rgb: [0.9, 0.8, 0.7], lamps: 6, brightness: 1.5}
  - {name: bath, min_m: [6, 0], max_m: [9, 5]}
doors:
  - {at_m: [6, 2], width_m: 1.0, open_deg: 45}
windows:
  - {at_m: [3, 5]}
)" + std::string(kCamera));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->name, "flat");
  EXPECT_EQ(scene->description, "two rooms");
  EXPECT_EQ(scene->duration_s, 12.5);
  EXPECT_EQ(scene->seed, 18446744073709551615U);
  const auto& hall = scene->rooms.at(0);
  EXPECT_EQ(hall.name, "hall");
  EXPECT_EQ(hall.height_m, 3.0);
  EXPECT_EQ(hall.wall_colour_rgb.value(), Eigen::Vector3d(0.9, 0.8, 0.7));
  EXPECT_EQ(hall.lamps, 6);
  EXPECT_EQ(hall.brightness, 1.5);
  EXPECT_EQ(scene->doors.at(0).open_deg, 45.0);
  EXPECT_EQ(scene->windows.at(0).position_m, Eigen::Vector2d(3.0, 5.0));
}

TEST_F(SceneFile, ReadsObjectsWithAnglesInDegreesAndMakesUpNamesThatAreFree) {
  const SceneDescription scene = scene_with(R"(objects:
  - {type: desk, at_m: [2, 3], yaw_deg: 90, look: 7, scale: [1, 1, 1.2]}
  - {type: desk, name: desk_1, at_m: [4, 3], scale: 0.5}
  - {type: cup, on: desk_1, at_m: [0.1, 0.2]}
  - {type: poster, at_m: [0, 2], height_m: 1.4}
relocations:
  - {object: cup_1, at_s: 3, to_m: [1, 1], yaw_deg: 180}
moves:
  - {object: desk_1, from_s: 1, to_s: 3, to_m: [2, 3]}
  - {object: desk_1, from_s: 3, to_s: 4.5, yaw_deg: -90}
)");
  ASSERT_EQ(scene.objects.size(), 4U);
  EXPECT_EQ(scene.objects[0].name, "desk_2");
  EXPECT_NEAR(scene.objects[0].pose.yaw_rad, std::numbers::pi / 2.0, 1e-12);
  EXPECT_EQ(scene.objects[0].look, 7U);
  EXPECT_THAT(scene.objects[0].scale, ElementsAre(1.0, 1.0, 1.2));
  EXPECT_THAT(scene.objects[1].scale, ElementsAre(0.5, 0.5, 0.5));
  EXPECT_EQ(scene.objects[2].on, "desk_1");
  EXPECT_EQ(scene.objects[3].height_m, 1.4);
  ASSERT_EQ(scene.relocations.size(), 1U);
  EXPECT_EQ(scene.relocations[0].object, "cup_1");
  EXPECT_NEAR(scene.relocations[0].to.yaw_rad, std::numbers::pi, 1e-12);
  ASSERT_EQ(scene.moves.size(), 2U);
  EXPECT_EQ(scene.moves[0].object, "desk_1");
  EXPECT_EQ(scene.moves[0].to_m, Eigen::Vector2d(2, 3));
  EXPECT_FALSE(scene.moves[0].yaw_rad.has_value());
  EXPECT_FALSE(scene.moves[1].to_m.has_value());
  EXPECT_NEAR(scene.moves[1].yaw_rad.value(), -std::numbers::pi / 2.0, 1e-12);
  EXPECT_EQ(scene.moves[1].to_s, 4.5);
}

TEST_F(SceneFile, ReadsAllThatPeopleDo) {
  const SceneDescription scene = scene_with(R"(objects:
  - {type: chair, name: seat, at_m: [2, 3]}
  - {type: cup, name: mug, at_m: [3, 3]}
people:
  - name: ann
    height_m: 1.68
    look: 3
    start: {at_m: [1, 2], yaw_deg: -90}
    begin_s: 1.5
    repeat: true
    actions:
      - walk: {path_m: [[2, 2], [3, 2]], speed_mps: 1.3, carry: mug}
      - sit: {on: seat, for_s: 6, gesture: type}
      - stand: {for_s: 2, gesture: wave, yaw_deg: 90}
      - push: {object: seat, path_m: [[4, 4]]}
      - pull: {object: seat, path_m: [[4, 2]], speed_mps: 0.5}
      - pause: {for_s: 1}
)");
  ASSERT_EQ(scene.people.size(), 1U);
  const auto& ann = scene.people[0];
  EXPECT_EQ(ann.height_m, 1.68);
  EXPECT_EQ(ann.start.position_m, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(ann.begin_s, 1.5);
  EXPECT_TRUE(ann.repeat);
  ASSERT_EQ(ann.actions.size(), 6U);
  EXPECT_EQ(ann.actions[0].kind, ActionKind::kWalk);
  EXPECT_THAT(ann.actions[0].path_m,
              ElementsAre(Eigen::Vector2d(2.0, 2.0), Eigen::Vector2d(3.0, 2.0)));
  EXPECT_EQ(ann.actions[0].carry, "mug");
  EXPECT_EQ(ann.actions[1].kind, ActionKind::kSit);
  EXPECT_EQ(ann.actions[1].object, "seat");
  EXPECT_EQ(ann.actions[1].gesture, "type");
  EXPECT_TRUE(ann.actions[2].has_yaw);
  EXPECT_EQ(ann.actions[3].kind, ActionKind::kPush);
  EXPECT_EQ(ann.actions[3].speed_mps, 0.6);
  EXPECT_FALSE(ann.actions[3].pull);
  EXPECT_TRUE(ann.actions[4].pull);
  EXPECT_EQ(ann.actions[5].kind, ActionKind::kPause);
  EXPECT_EQ(ann.actions[5].duration_s, 1.0);
}

TEST_F(SceneFile, ReadsCameraAndSensorInUnitsOfTheStructs) {
  const auto scene = load(std::string(kRooms) + R"(camera:
  waypoints:
    - {at_s: 0, position_m: [1, 1, 1.4], look_at_m: [3, 3, 1], roll_deg: 90}
    - {at_s: 2, position_m: [2, 1, 1.4], look_at_m: [3, 3, 1]}
  tremor_position_mm: 4
  tremor_rotation_deg: 0.5
  covered_s: [[8, 9], [10, 11.5]]
sensor:
  width: 320
  height: 240
  rate_hz: 15
  min_depth_m: 0.5
  max_depth_m: 5
  depth_noise: false
  rolling_shutter: true
  exposure_ms: 20
  readout_ms: 10
)");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(scene->camera.waypoints.at(0).roll_rad, std::numbers::pi / 2.0, 1e-12);
  EXPECT_NEAR(scene->camera.tremor_position_m, 0.004, 1e-12);
  EXPECT_NEAR(scene->camera.tremor_rotation_rad, 0.5 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_THAT(scene->camera.covered_s, ElementsAre(std::pair(8.0, 9.0), std::pair(10.0, 11.5)));
  EXPECT_EQ(scene->sensor.camera.width, 320);
  EXPECT_DOUBLE_EQ(scene->sensor.camera.fx, 535.4 / 2.0);
  EXPECT_EQ(scene->sensor.rate_hz, 15.0);
  EXPECT_FALSE(scene->sensor.depth_noise);
  EXPECT_TRUE(scene->sensor.rolling_shutter);
  EXPECT_NEAR(scene->sensor.exposure_s, 0.020, 1e-12);
}

TEST_F(SceneFile, TakesTheCameraOfATrajectoryFileBesideIt) {
  folder_.write("path.txt", "0.0 1 1 1.4 0 0 0 1\n1.0 2 1 1.4 0 0 0 1\n");
  const auto scene = load(std::string(kRooms) + "camera: {trajectory_file: path.txt}\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->camera.trajectory_file, folder_ / "path.txt");
}

TEST_F(SceneFile, ThatIsNotThereIsMissingInput) {
  const auto scene = load_scene_with(kCatalogue, folder_ / "none.yaml");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ExitCode::kMissingInput);
  EXPECT_EQ(scene.error().message, "there is no file " + (folder_ / "none.yaml").string() +
                                       "; give a scene file (docs/simulation.md)");
}

TEST_F(SceneFile, MessageNamesFileLineAndKeyUnderATitleWithTheirNumber) {
  const auto scene = load(std::string(kRooms) + kCamera + "seed: -1\n");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message, "the scene has 1 problem:\n  " +
                                       (folder_ / "room.yaml").string() +
                                       ":3: seed: must be a whole number, 0 or more");
}

TEST_F(SceneFile, ThatIsEmptyOrNoSceneSaysSo) {
  EXPECT_THAT(problems_of(""),
              ElementsAre("1: the file is empty; docs/simulation.md says what a scene has"));
  EXPECT_THAT(problems_of("just words\n"),
              ElementsAre("1: must hold the keys of a scene, e.g. 'rooms:'"));
}

TEST_F(SceneFile, ThatIsNotYamlNamesTheLine) {
  EXPECT_THAT(problems_of("name: room\nrooms: [{min_m: [0, 0]\n"),
              ElementsAre("3: not valid YAML: end of map flow not found"));
}

}  // namespace
}  // namespace tsg
