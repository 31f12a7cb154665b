#include "common/simulation/world/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace tsg::simulation {
namespace {

/// A room with a desk, a cup on it and a chair.
SceneDescription furnished_room() {
  SceneDescription scene;
  scene.rooms = {{.name = "office", .min_m = {0, 0}, .max_m = {6, 5}}};
  scene.objects = {
      {.type = "cup", .name = "cup", .on = "desk", .pose = {{0.2, 0.1}, 0.0}},
      {.type = "desk", .name = "desk", .pose = {{2.0, 1.0}, 1.5707963}},
      {.type = "office_chair", .name = "chair", .pose = {{4.0, 2.0}, 0.0}},
  };
  scene.camera.waypoints = {{.position_m = {1, 4, 1.4}, .look_at_m = {3, 1, 0.8}}};
  return scene;
}

ActionDescription push(const std::string& object) {
  return {.kind = ActionKind::kPush, .path_m = {{5.0, 3.5}}, .speed_mps = 0.5, .object = object};
}

PersonDescription pusher(const std::string& object) {
  return {.name = "anna", .start = {{2.5, 2.5}, 0.0}, .actions = {push(object)}};
}

std::string build_error(const SceneDescription& scene) {
  const auto world = World::build(scene);
  if (world) return "";
  EXPECT_EQ(world.error().code, ExitCode::kBadData);
  return world.error().message;
}

int id_of(const World& world, const std::string& name) {
  return std::ranges::find(world.instances(), name, &SimulatedInstance::name)->id;
}

bool is_dynamic(const World& world, const std::string& name) {
  return std::ranges::find(world.instances(), name, &SimulatedInstance::name)->is_dynamic;
}

TEST(World, ThingsStandOnWhatTheyAreSaidToStandOn) {
  const World world = value_or_throw(World::build(furnished_room()));
  const Eigen::Vector3d cup = world.T_world_object("cup", 0.0).translation();
  EXPECT_NEAR(cup.x(), 2.0 - 0.1, 1e-6);
  EXPECT_NEAR(cup.y(), 1.0 + 0.2, 1e-6);
  EXPECT_GT(cup.z(), 0.6);
  EXPECT_LT(cup.z(), 0.85);
}

TEST(World, EachThingAndPersonIsAnInstanceOfItsClass) {
  SceneDescription scene = furnished_room();
  scene.people = {pusher("chair")};
  const World world = value_or_throw(World::build(scene));
  ASSERT_EQ(world.instances().size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(world.instances()[i].id, static_cast<int>(i) + 1);
  EXPECT_EQ(world.instances().back().class_name, "person");
  EXPECT_TRUE(is_dynamic(world, "chair"));
  EXPECT_FALSE(is_dynamic(world, "desk"));
  EXPECT_EQ(world.fixed().size(), 3U) << "building, desk, cup";
  EXPECT_EQ(world.bodies().size(), 2U) << "chair, person";
}

TEST(World, PushedThingsMoveAndAreToldAsMovingWhileTheyDo) {
  SceneDescription scene = furnished_room();
  scene.people = {pusher("chair")};
  const World world = value_or_throw(World::build(scene));
  const auto is_moving = [&](double time_s) {
    const std::vector<int> ids = world.moving(time_s);
    return std::ranges::find(ids, id_of(world, "chair")) != ids.end();
  };
  EXPECT_FALSE(is_moving(0.0));
  EXPECT_FALSE(is_moving(60.0));
  bool ever = false;
  for (double time_s = 0.0; time_s < 30.0; time_s += 0.1) ever = ever || is_moving(time_s);
  EXPECT_TRUE(ever);
  EXPECT_GT((world.T_world_object("chair", 60.0).translation() - Eigen::Vector3d(4, 2, 0)).norm(),
            0.5);
}

TEST(World, RelocatedThingsTakeAlongWhatStandsOnThem) {
  SceneDescription scene = furnished_room();
  scene.relocations = {{.object = "desk", .at_s = 2.0, .to = {{3.0, 3.0}, 0.0}}};
  const World world = value_or_throw(World::build(scene));
  EXPECT_TRUE(is_dynamic(world, "cup"));
  EXPECT_TRUE(
      world.T_world_object("desk", 1.99).translation().head<2>().isApprox(Eigen::Vector2d(2, 1)));
  EXPECT_TRUE(
      world.T_world_object("desk", 2.01).translation().head<2>().isApprox(Eigen::Vector2d(3, 3)));
  EXPECT_TRUE(world.T_world_object("cup", 2.01)
                  .translation()
                  .head<2>()
                  .isApprox(Eigen::Vector2d(3.2, 3.1)));
}

TEST(World, ThingsMoveByThemselvesGentlyAndAreToldAsMovingWhileTheyDo) {
  SceneDescription scene = furnished_room();
  scene.moves = {
      {.object = "desk", .from_s = 1.0, .to_s = 3.0, .to_m = Eigen::Vector2d(4, 1)},
      {.object = "desk", .from_s = 5.0, .to_s = 6.0, .yaw_rad = 0.0},
  };
  const World world = value_or_throw(World::build(scene));
  const auto place = [&](double time_s) -> Eigen::Vector2d {
    return world.T_world_object("desk", time_s).translation().head<2>();
  };
  EXPECT_TRUE(place(0.5).isApprox(Eigen::Vector2d(2, 1)));
  EXPECT_TRUE(place(2.0).isApprox(Eigen::Vector2d(3, 1))) << "halfway";
  EXPECT_LT(place(1.2).x() - 2.0, 0.1 * 2.0) << "slower than evenly at first";
  EXPECT_TRUE(place(9.0).isApprox(Eigen::Vector2d(4, 1)));
  EXPECT_TRUE(world.T_world_object("desk", 9.0).rotation_matrix().isIdentity(1e-9));
  EXPECT_TRUE(world.T_world_object("cup", 9.0)
                  .translation()
                  .head<2>()
                  .isApprox(Eigen::Vector2d(4.2, 1.1), 1e-6))
      << "what stands on it goes along";
  for (const auto& [time_s, moves] :
       {std::pair{0.9, false}, {2.0, true}, {4.0, false}, {5.5, true}, {6.1, false}}) {
    for (const char* name : {"desk", "cup"}) {
      const std::vector<int> ids = world.moving(time_s);
      EXPECT_EQ(std::ranges::find(ids, id_of(world, name)) != ids.end(), moves)
          << name << " at " << time_s << " s";
    }
  }
}

TEST(World, PosesBodiesWhereTheirObjectsAre) {
  SceneDescription scene = furnished_room();
  scene.relocations = {{.object = "chair", .at_s = 2.0, .to = {{1.0, 3.0}, 0.0}}};
  const World world = value_or_throw(World::build(scene));
  ASSERT_EQ(world.bodies().size(), 1U);
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  world.pose_body(0, 3.0, points, normals);
  ASSERT_EQ(points.size(), world.bodies()[0].mesh.points.size());
  for (const Eigen::Vector3f& point : points) {
    EXPECT_LT((point.head<2>() - Eigen::Vector2f(1, 3)).norm(), 0.8F);
  }
}

TEST(World, NamesWhatDoesNotFit) {
  SceneDescription scene = furnished_room();
  scene.objects[1].type = "throne";
  EXPECT_EQ(build_error(scene), "object 'desk' is of the unknown type 'throne'");

  scene = furnished_room();
  scene.objects[1].on = "cup";
  EXPECT_EQ(
      build_error(scene),
      "object 'cup' stands on 'desk', which stands nowhere; name an object that stands on the "
      "floor");

  scene = furnished_room();
  scene.objects[2].name = "cup";
  EXPECT_EQ(build_error(scene), "there are two objects called 'cup'; rename one");

  scene = furnished_room();
  scene.relocations = {{.object = "sofa", .at_s = 1.0}};
  EXPECT_EQ(build_error(scene), "there is no object 'sofa' that could be relocated");

  scene = furnished_room();
  scene.people = {pusher("chair")};
  scene.relocations = {{.object = "chair", .at_s = 1.0}};
  EXPECT_EQ(build_error(scene),
            "object 'chair' is relocated, and moved by a person as well; keep one of both");

  scene = furnished_room();
  scene.moves = {{.object = "sofa", .from_s = 1.0, .to_s = 2.0}};
  EXPECT_EQ(build_error(scene), "there is no object 'sofa' that could be moved");

  scene = furnished_room();
  scene.moves = {{.object = "chair", .from_s = 1.0, .to_s = 2.0}};
  scene.relocations = {{.object = "chair", .at_s = 1.0}};
  EXPECT_EQ(build_error(scene),
            "object 'chair' moves by itself, and is relocated as well; keep one of both");

  scene = furnished_room();
  scene.people = {pusher("piano")};
  EXPECT_NE(build_error(scene).find("piano"), std::string::npos);
}

}  // namespace
}  // namespace tsg::simulation
