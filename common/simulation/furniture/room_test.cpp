#include "common/simulation/furniture/room.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace tsg::simulation {
namespace {

/// Two rooms side by side, 4 x 3 m each, joined by a door; the first has a window to the south.
SceneDescription two_rooms() {
  SceneDescription scene;
  RoomDescription room;
  room.name = "left";
  room.max_m = {4.0, 3.0};
  scene.rooms.push_back(room);
  room.name = "right";
  room.min_m = {4.0, 0.0};
  room.max_m = {8.0, 3.0};
  room.floor = "parquet";
  room.walls = "brick";
  scene.rooms.push_back(room);
  scene.doors = {{.position_m = {4.0, 1.5}, .width_m = 0.9, .open_deg = 90.0}};
  scene.windows = {{.position_m = {2.0, 0.0}, .width_m = 1.4}};
  return scene;
}

/// Whether the straight way between two points is blocked by any face.
bool is_blocked(const render::Mesh& mesh, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  const Eigen::Vector3f way = to - from;
  return std::ranges::any_of(mesh.triangles, [&](const render::Triangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    const Eigen::Vector3f ab = mesh.points[b] - mesh.points[a];
    const Eigen::Vector3f ac = mesh.points[c] - mesh.points[a];
    // Moeller and Trumbore, 1997.
    const Eigen::Vector3f across = way.cross(ac);
    const float determinant = ab.dot(across);
    if (std::abs(determinant) < 1e-12F) return false;
    const Eigen::Vector3f offset = from - mesh.points[a];
    const float u = offset.dot(across) / determinant;
    const Eigen::Vector3f around = offset.cross(ab);
    const float v = way.dot(around) / determinant;
    const float share = ac.dot(around) / determinant;
    return u >= 0.0F && v >= 0.0F && u + v <= 1.0F && share > 0.0F && share < 1.0F;
  });
}

TEST(Building, HasASoundMesh) {
  const render::Mesh mesh = make_building(two_rooms()).shell;
  ASSERT_EQ(mesh.normals.size(), mesh.points.size());
  ASSERT_EQ(mesh.uvs.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    ASSERT_TRUE(mesh.points[i].allFinite());
    ASSERT_TRUE(mesh.uvs[i].allFinite());
    ASSERT_NEAR(mesh.normals[i].norm(), 1.0F, 1e-3F);
  }
  for (const render::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle.corners) ASSERT_LT(corner, mesh.points.size());
    ASSERT_LT(triangle.material, mesh.materials.size());
  }
}

TEST(Building, IsTheSameForTheSameScene) {
  const Building first = make_building(two_rooms());
  const Building again = make_building(two_rooms());
  EXPECT_EQ(first.shell.points, again.shell.points);
  EXPECT_EQ(first.shell.uvs, again.shell.uvs);
  EXPECT_EQ(first.lamps.size(), again.lamps.size());
}

TEST(Building, LetsOneThroughAnOpenDoor) {
  const render::Mesh shell = make_building(two_rooms()).shell;
  for (const float z : {0.3F, 1.0F, 1.9F}) {
    EXPECT_FALSE(is_blocked(shell, {3.0F, 1.5F, z}, {5.0F, 1.5F, z})) << "at height " << z;
  }
  EXPECT_TRUE(is_blocked(shell, {3.0F, 1.5F, 2.4F}, {5.0F, 1.5F, 2.4F})) << "above the door";
}

TEST(Building, HasWallsWithoutDoorsEverywhereElse) {
  const render::Mesh shell = make_building(two_rooms()).shell;
  for (const float y : {0.3F, 0.8F, 2.3F, 2.8F}) {
    EXPECT_TRUE(is_blocked(shell, {3.0F, y, 1.2F}, {5.0F, y, 1.2F})) << "at y = " << y;
  }
  EXPECT_TRUE(is_blocked(shell, {1.0F, 1.5F, 1.2F}, {-1.0F, 1.5F, 1.2F}));
  EXPECT_TRUE(is_blocked(shell, {1.0F, 1.5F, 1.2F}, {1.0F, 4.0F, 1.2F}));
  EXPECT_TRUE(is_blocked(shell, {1.0F, 1.5F, 1.2F}, {1.0F, 1.5F, -1.0F}));
  EXPECT_TRUE(is_blocked(shell, {1.0F, 1.5F, 1.2F}, {1.0F, 1.5F, 4.0F}));
}

TEST(Building, KeepsADoorToNowhereShut) {
  SceneDescription scene = two_rooms();
  scene.doors.push_back({.position_m = {0.0, 1.5}, .width_m = 0.9, .open_deg = 90.0});
  const render::Mesh shell = make_building(scene).shell;
  EXPECT_TRUE(is_blocked(shell, {1.0F, 1.5F, 0.7F}, {-1.0F, 1.5F, 0.7F}));
}

TEST(Building, ShowsTheOutsideThroughAWindow) {
  const render::Mesh shell = make_building(two_rooms()).shell;
  const Eigen::Vector3f inside(1.7F, 1.5F, 1.5F);
  EXPECT_FALSE(is_blocked(shell, inside, {1.7F, -0.4F, 1.5F})) << "the hole is open";
  // What is seen lies behind it, wherever one looks from.
  for (const float x : {-2.0F, 0.5F, 1.7F, 3.0F, 6.0F}) {
    const Eigen::Vector3f hole(1.7F, 0.0F, 1.5F);
    const Eigen::Vector3f from(x > 2.0F ? 0.3F : 3.7F, 0.8F, 1.5F);
    EXPECT_TRUE(is_blocked(shell, hole, hole + 4.0F * (hole - from))) << "towards " << x;
  }
}

TEST(Building, HasALampPerPanelAndWindow) {
  SceneDescription scene = two_rooms();
  scene.rooms.front().lamps = 5;
  scene.rooms.back().lamps = 0;
  const std::vector<Lamp> lamps = make_building(scene).lamps;
  ASSERT_EQ(lamps.size(), 6U);
  EXPECT_EQ(std::ranges::count_if(lamps, [](const Lamp& lamp) { return lamp.normal.z() < -0.9F; }),
            5);
  const Lamp& window = lamps.back();
  EXPECT_NEAR(window.normal.y(), 1.0F, 1e-5F);
  EXPECT_NEAR(window.centre_m.x(), 2.0F, 1e-4F);
}

TEST(Building, TakesTheColourThatARoomAsksFor) {
  SceneDescription scene = two_rooms();
  scene.rooms.resize(1);
  scene.doors.clear();
  scene.rooms.front().wall_colour_rgb = Eigen::Vector3d(0.8, 0.1, 0.1);
  const render::Mesh shell = make_building(scene).shell;
  // The first face is a wall.
  const render::Material& wall = shell.materials[shell.triangles.front().material];
  ASSERT_NE(wall.texture, nullptr);
  const Eigen::Vector3f mean = wall.texture->sample({0.5F, 0.5F}, 1.0F);
  EXPECT_GT(mean.z(), 3.0F * mean.x());
}

TEST(Building, BuildsEverySurfaceOnFloorsAndWalls) {
  const std::vector<std::string> names = surface_names();
  EXPECT_TRUE(std::ranges::is_sorted(names));
  EXPECT_THAT(names, testing::IsSupersetOf({"carpet", "plaster"}));
  for (const std::string& name : names) {
    SceneDescription scene = two_rooms();
    scene.rooms.resize(1);
    scene.rooms.front().floor = name;
    scene.rooms.front().walls = name;
    EXPECT_FALSE(make_building(scene).shell.triangles.empty()) << name;
  }
}

TEST(Building, LaysBoardsThatEndAtTheEdgeOfTheirPicture) {
  SceneDescription scene = two_rooms();
  scene.rooms.resize(1);
  scene.rooms.front().floor = "laminate";
  scene.seed = 100'002;  // with it a board begins at the very edge
  EXPECT_FALSE(make_building(scene).shell.triangles.empty());
}

TEST(Building, KeepsToItsBudgetOfTriangles) {
  EXPECT_LT(make_building(two_rooms()).shell.triangles.size(), 20000U);
}

}  // namespace
}  // namespace tsg::simulation
