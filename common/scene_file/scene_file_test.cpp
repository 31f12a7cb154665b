#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "common/scene_file/scene_sections.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using simulation::ActionKind;
using simulation::SceneDescription;
using test::TempFolder;
using ::testing::ElementsAre;

const Catalogue kCatalogue{.furniture = {"chair", "cup", "desk", "poster"},
                           .surfaces = {"carpet", "plaster"}};

constexpr const char* kRooms = "rooms: [{min_m: [0, 0], max_m: [6, 5]}]\n";
constexpr const char* kCamera =
    "camera: {waypoints: [{at_s: 0, position_m: [1, 1, 1.4], look_at_m: [3, 3, 1]}]}\n";

class SceneFile : public ::testing::Test {
 protected:
  Expected<SceneDescription> load(const std::string& text) {
    return load_scene_with(kCatalogue, folder_.write("room.yaml", text));
  }

  /// A whole scene with `text` from line 3 on.
  SceneDescription scene_with(const std::string& text) {
    auto scene = load(kRooms + std::string(kCamera) + text);
    EXPECT_TRUE(scene) << scene.error().message;
    return scene.value_or(SceneDescription{});
  }

  /// What loading says, "LINE: message" each.
  std::vector<std::string> problems_of(const std::string& text) {
    const auto scene = load(text);
    if (scene) return {};
    EXPECT_EQ(scene.error().code, ExitCode::kConfig);
    std::vector<std::string> lines;
    std::istringstream stream(scene.error().message);
    const std::string start = "  " + (folder_ / "room.yaml").string() + ":";
    std::string line;
    std::getline(stream, line);  // how many there are
    while (std::getline(stream, line)) {
      EXPECT_TRUE(line.starts_with(start)) << line;
      lines.push_back(line.substr(std::min(line.size(), start.size())));
    }
    return lines;
  }

  std::vector<std::string> problems_with(const std::string& text) {
    return problems_of(kRooms + std::string(kCamera) + text);
  }

  TempFolder folder_;
};

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

/// A file's text after the rooms and the camera, and all that must be said about it.
struct Mistake {
  const char* name;
  const char* text;
  std::vector<std::string> problems;
};

class SceneMistake : public SceneFile, public ::testing::WithParamInterface<Mistake> {};

TEST_P(SceneMistake, IsToldWithLineAndKey) {
  EXPECT_EQ(problems_with(GetParam().text), GetParam().problems);
}

const std::vector<Mistake> kMistakes{
    {"UnknownKey",
     "objects:\n  - {type: desk, at: [1, 1]}\n",
     {"4: objects[0].at: unknown key; did you mean at_m?", "4: objects[0].at_m: is missing"}},
    {"UnknownTopLevelKey",
     "persons: []\n",
     {"3: persons: unknown key; known: rooms name description duration_s seed doors windows "
      "objects "
      "people relocations moves camera sensor"}},
    {"MissingKeys", "objects:\n  - {at_m: [1, 1]}\n", {"4: objects[0].type: is missing"}},
    {"KeyGivenTwice", "seed: 1\nseed: 2\n", {"4: seed: is given twice, first in line 3"}},
    {"KeyWithoutValue", "seed:\n", {"3: seed: has no value; give one or remove the line"}},
    {"TextForNumber", "duration_s: long\n", {"3: duration_s: must be a number"}},
    {"QuotedNumber", "duration_s: \"3\"\n", {"3: duration_s: must be a number"}},
    {"NumberForMap", "sensor: 3\n", {"3: sensor: must hold keys with values, e.g. {name: value}"}},
    {"MapForList", "objects: {}\n", {"3: objects: must be a list"}},
    {"ShortPoint",
     "objects: [{type: desk, at_m: [1]}]\n",
     {"3: objects[0].at_m: must be a list of 2 numbers"}},
    {"WordInPoint",
     "objects: [{type: desk, at_m: [1, x]}]\n",
     {"3: objects[0].at_m: must be a number"}},
    {"NotABool", "sensor: {depth_noise: 3}\n", {"3: sensor.depth_noise: must be true or false"}},
    {"NotWhole", "sensor: {width: 320.5}\n", {"3: sensor.width: must be a whole number"}},
    {"OutOfRange",
     "duration_s: 0\nsensor: {width: 4000}\n",
     {"3: duration_s: must be 0.1 to 86400, not 0",
      "4: sensor.width: must be 16 to 1280, not 4000"}},
    {"Nan", "duration_s: .nan\n", {"3: duration_s: must be finite, not .nan"}},
    {"NanAsAWord", "duration_s: nan\n", {"3: duration_s: must be finite, not nan"}},
    {"Infinity",
     "objects: [{type: desk, at_m: [1, -.inf]}]\n",
     {"3: objects[0].at_m: must be finite, not -.inf"}},
    {"NameTaken",
     "objects:\n  - {type: desk, name: a, at_m: [1, 1]}\n  - {type: desk, name: a, at_m: [3, 3]}\n",
     {"5: name: \"a\" is taken in line 4; objects and people need names of their own"}},
    {"UnknownObjectUnderneath",
     "objects:\n  - {type: desk, name: desk_a, at_m: [1, 1]}\n  - {type: cup, on: desk_b}\n",
     {"5: objects[1].on: there is no object \"desk_b\"; did you mean desk_a?"}},
    {"StandsOnItself",
     "objects:\n  - {type: cup, name: a, on: b}\n  - {type: cup, name: b, on: a}\n",
     {"4: objects[0].on: \"a\" stands on itself in the end; break the circle",
      "5: objects[1].on: \"b\" stands on itself in the end; break the circle"}},
    {"UnknownType",
     "objects: [{type: chiar, at_m: [1, 1]}]\n",
     {"3: objects[0].type: there is no \"chiar\"; did you mean chair?"}},
    {"HeightOfAThingOnATable",
     "objects:\n  - {type: desk, at_m: [1, 1]}\n  - {type: cup, on: desk_1, height_m: 1}\n",
     {"5: objects[1].height_m: is for things on walls; what is `on` something needs none"}},
    {"ObjectOutside",
     "objects: [{type: desk, at_m: [31, 2]}]\n",
     {"3: objects[0].at_m: is outside all rooms"}},
    {"DoorOnNoWall",
     "doors: [{at_m: [3, 3]}]\n",
     {"3: doors[0].at_m: is on no wall; put it within 0.3 m of one"}},
    {"WindowRoundTheCorner",
     "windows: [{at_m: [0.2, 5]}]\n",
     {"3: windows[0].at_m: leaves less than 0.11 m to the end of its wall; move it or make it "
      "narrower"}},
    {"DoorWithoutRoomForItsPost",
     "doors: [{at_m: [0, 0.5], width_m: 0.9}]\n",
     {"3: doors[0].at_m: leaves less than 0.11 m to the end of its wall; move it or make it "
      "narrower"}},
    {"UnknownAction",
     "people:\n  - start: {at_m: [1, 1]}\n    actions:\n      - wlak: {path_m: [[1, 1]]}\n",
     {"6: people[0].actions[0].wlak: unknown key; did you mean walk?"}},
    {"TwoActionsInOne",
     "people:\n  - start: {at_m: [1, 1]}\n    actions:\n      - {pause: {for_s: 1}, walk: {}}\n",
     {"6: people[0].actions[0]: must hold one key; known: walk sit stand push pull pause"}},
    {"PersonWithoutStart", "people: [{name: ann}]\n", {"3: people[0].start: is missing"}},
    {"PersonUsesUnknownThings",
     "people:\n  - start: {at_m: [1, 1]}\n    actions:\n"
     "      - sit: {on: stool, for_s: 1}\n"
     "      - push: {object: box, path_m: [[2, 2]]}\n"
     "      - walk: {path_m: [[2, 2]], carry: bag}\n",
     {"6: people[0].actions[0].sit.on: there is no object \"stool\"; there is none",
      "7: people[0].actions[1].push.object: there is no object \"box\"; there is none",
      "8: people[0].actions[2].walk.carry: there is no object \"bag\"; there is none"}},
    {"WalkWithoutCorners",
     "people:\n  - start: {at_m: [1, 1]}\n    actions:\n      - walk: {path_m: []}\n",
     {"6: people[0].actions[0].walk.path_m: must have at least one corner, e.g. [[1.0, 2.0]]"}},
    {"WalkThroughTheWall",
     "people:\n  - start: {at_m: [1, 1]}\n    actions:\n      - walk: {path_m: [[2, 2], [9, 2]]}\n",
     {"6: people[0].actions[0].walk.path_m[1]: is outside all rooms"}},
    {"UnknownGesture",
     "people:\n  - start: {at_m: [1, 1]}\n    actions:\n      - stand: {for_s: 1, gesture: wvae}\n",
     {"6: people[0].actions[0].stand.gesture: there is no \"wvae\"; did you mean wave?"}},
    {"RelocationOfNothing",
     "relocations: [{object: sofa, at_s: 1, to_m: [1, 1]}]\n",
     {"3: relocations[0].object: there is no object \"sofa\"; there is none"}},
    {"MoveOfNothing",
     "moves: [{object: sofa, from_s: 1, to_s: 2, yaw_deg: 3}]\n",
     {"3: moves[0].object: there is no object \"sofa\"; there is none"}},
    {"MovesThatCannotBe",
     "objects: [{type: desk, name: d, at_m: [1, 1]}]\nmoves:\n"
     "  - {object: d, from_s: 3, to_s: 3, yaw_deg: 3}\n"
     "  - {object: d, from_s: 2, to_s: 5}\n"
     "  - {object: d, from_s: 6, to_s: 7, to_m: [-9, 1]}\n",
     {"5: moves[0].to_s: must be later than from_s", "6: moves[1]: needs to_m, yaw_deg or both",
      "6: moves[1].from_s: must not be before the end of the object's move before",
      "7: moves[2].to_m: is outside all rooms"}},
    {"HalfTheIntrinsics",
     "sensor: {fx: 500, fy: 500}\n",
     {"3: sensor: needs all of fx, fy, cx and cy, or none"}},
    {"EmptyDepthRange",
     "sensor: {min_depth_m: 3, max_depth_m: 2}\n",
     {"3: sensor.max_depth_m: must be more than min_depth_m"}},
};

INSTANTIATE_TEST_SUITE_P(All, SceneMistake, ::testing::ValuesIn(kMistakes), [](const auto& test) {
  return test.param.name;
});

TEST_F(SceneFile, CameraMistakesAreToldWithLineAndKey) {
  EXPECT_THAT(problems_of(std::string(kRooms) + R"(camera:
  waypoints:
    - {at_s: 1, position_m: [1, 1, 1.4], look_at_m: [3, 3, 1]}
    - {at_s: 1, position_m: [7, 1, 1.4], look_at_m: [3, 3, 1]}
    - {at_s: 2, position_m: [1, 1, 2.8], look_at_m: [1, 1, 2.8]}
  covered_s: [[9, 8]]
)"),
              ElementsAre("5: camera.waypoints[1].position_m: is outside all rooms",
                          "5: camera.waypoints[1].at_s: must be later than that of the waypoint "
                          "before",
                          "6: camera.waypoints[2].position_m: is outside all rooms",
                          "6: camera.waypoints[2].look_at_m: must be at least 0.05 m from "
                          "position_m",
                          "7: camera.covered_s[0]: must end after it begins"));
}

TEST_F(SceneFile, CameraNeedsEitherWaypointsOrATrajectory) {
  const std::string rooms = kRooms;
  EXPECT_THAT(problems_of(rooms), ElementsAre("1: camera: is missing"));
  EXPECT_THAT(problems_of(rooms + "camera: {tremor_position_mm: 1}\n"),
              ElementsAre("2: camera: needs either waypoints or trajectory_file"));
  EXPECT_THAT(problems_of(rooms + "camera: {waypoints: []}\n"),
              ElementsAre("2: camera.waypoints: must have at least one"));
}

TEST_F(SceneFile, TrajectoryThatIsAbsentOrLeavesTheRoomIsNamed) {
  const std::string text = std::string(kRooms) + "camera: {trajectory_file: path.txt}\n";
  const std::string path = (folder_ / "path.txt").string();
  EXPECT_THAT(
      problems_of(text),
      ElementsAre(::testing::StartsWith("2: camera.trajectory_file: there is no file " + path)));
  folder_.write("path.txt", "0.0 1 1 1.4 0 0 0 1\n1.0 20 1 1.4 0 0 0 1\n");
  EXPECT_THAT(problems_of(text),
              ElementsAre("2: camera.trajectory_file: its pose 2 is outside all rooms; bring it "
                          "into the axes of the scene"));
}

TEST_F(SceneFile, RoomMistakesAreToldWithLineAndKey) {
  EXPECT_THAT(problems_of(R"(rooms:
  - {name: a, min_m: [0, 0], max_m: [6, 5], floor: carpte}
  - {name: a, min_m: [5, 0], max_m: [9, 5]}
  - {name: c, min_m: [20, 0], max_m: [20, 5], lamps: 1.5}
)" + std::string(kCamera)),
              ElementsAre("2: rooms[0].floor: there is no \"carpte\"; did you mean carpet?",
                          "3: rooms[1].min_m: overlaps room \"a\"; rooms may touch, not overlap",
                          "3: rooms[1].name: \"a\" is the name of another room",
                          "4: rooms[2].lamps: must be a whole number",
                          "4: rooms[2].max_m: must be 1 to 200 m beyond min_m in x and y"));
}

TEST_F(SceneFile, WithoutRoomsSaysSo) {
  EXPECT_THAT(problems_of(std::string("rooms: []\n") + kCamera),
              ElementsAre("1: rooms: must have at least one"));
}

}  // namespace
}  // namespace tsg
