// What is said of scene files with mistakes in them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/scene_file/scene_file_fixture.hpp"

namespace tsg {
namespace {

using ::testing::ElementsAre;

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
