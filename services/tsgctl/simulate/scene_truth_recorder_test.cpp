#include "services/tsgctl/simulate/scene_truth_recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tsg {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// A room with a chair that is moved by itself from (2, 1) to (3, 1), a box that stays, and
/// somebody who walks along y = 2.
simulation::SceneDescription small_scene() {
  simulation::SceneDescription scene;
  scene.rooms.push_back({.min_m = {0.0, 0.0}, .max_m = {5.0, 4.0}});
  scene.objects.push_back(
      {.type = "wooden_chair", .name = "chair", .pose = {.position_m = {2.0, 1.0}}});
  scene.objects.push_back({.type = "cardboard_box",
                           .name = "box",
                           .pose = {.position_m = {4.0, 3.0}, .yaw_rad = 0.5},
                           .scale = {2.0, 1.0, 1.0}});
  scene.moves.push_back({.object = "chair", .from_s = 1.0, .to_s = 2.0, .to_m = {{3.0, 1.0}}});
  scene.people.push_back(
      {.name = "ann",
       .start = {.position_m = {1.0, 2.0}},
       .actions = {{.kind = simulation::ActionKind::kWalk, .path_m = {{4.0, 2.0}}}}});
  return scene;
}

class RecordedTruth : public testing::Test {
 protected:
  RecordedTruth() {
    for (int i = 0; i <= 16; ++i) recorder_.add_frame(i * kSecond / 4, 0.25 * i);
  }
  const TrueObject& object(const std::string& name) {
    return *std::ranges::find(recorder_.truth().objects, name, &TrueObject::name);
  }
  simulation::World world_ = value_or_throw(simulation::World::build(small_scene()));
  SceneTruthRecorder recorder_{world_};
};

TEST_F(RecordedTruth, ThingsHaveTheirBoxesAndPeopleNone) {
  EXPECT_EQ(recorder_.truth().objects.size(), 2U);
  const TrueObject& box = object("box");
  ASSERT_EQ(box.boxes.size(), 1U);
  EXPECT_NEAR(box.boxes[0].centre_m.x(), 4.0F, 0.05F);
  EXPECT_NEAR(box.boxes[0].centre_m.z(), 0.5F * box.boxes[0].size_m.z(), 0.02F);
  EXPECT_NEAR(box.boxes[0].yaw_rad, 0.5F, 1e-4F);
  EXPECT_GT(box.boxes[0].size_m.x(), 1.3F * box.boxes[0].size_m.y());
}

TEST_F(RecordedTruth, AThingThatMovesHasABoxForEachOfItsPlaces) {
  const TrueObject& chair = object("chair");
  EXPECT_EQ(chair.boxes.size(), 5U);  // before, at three frames of the way, and at its end
  EXPECT_NEAR(chair.box_at(0).centre_m.x() + 1.0F, chair.box_at(4 * kSecond).centre_m.x(), 1e-3F);
}

TEST_F(RecordedTruth, PeopleSweepWhereTheyWalkAndNothingElse) {
  const VoxelSet& swept = recorder_.truth().swept_by_people;
  EXPECT_TRUE(swept.contains({1.0F, 2.0F, 1.2F}));
  EXPECT_TRUE(swept.contains({2.5F, 2.0F, 1.2F}));
  EXPECT_FALSE(swept.contains({2.5F, 3.0F, 1.2F}));
  EXPECT_FALSE(swept.contains({2.5F, 2.0F, 2.2F}));
}

TEST_F(RecordedTruth, SurfacesAreThoseOfTheRoomAndOfThingsWhereverTheyWere) {
  const VoxelSet& surfaces = recorder_.truth().surfaces;
  EXPECT_TRUE(surfaces.has_near({2.0F, 3.5F, 0.0F}, 1));  // the floor
  EXPECT_FALSE(surfaces.has_near({2.0F, 2.0F, 1.2F}, 1));
  for (const float x : {2.0F, 2.5F, 3.0F}) {
    EXPECT_TRUE(surfaces.has_near({x, 1.0F, 0.45F}, 1)) << "the chair's seat at " << x;
  }
}

}  // namespace
}  // namespace tsg
