// Sections rooms, doors and windows.
#include <algorithm>
#include <array>
#include <cmath>

#include "common/scene_file/scene_sections.hpp"

namespace tsg {
namespace {

using simulation::OpeningDescription;
using simulation::RoomDescription;
using simulation::SceneDescription;

constexpr double kWallReach = 0.3;  // metres; doors and windows: scene.hpp
constexpr double kCorner = 0.11;    // metres at a wall's end: half the next wall, and a pillar

/// A wall seen from above.
struct Wall {
  Eigen::Vector2d from_m;
  Eigen::Vector2d to_m;

  /// Along the wall from `from_m`, and away from it.
  [[nodiscard]] Eigen::Vector2d coordinates(const Eigen::Vector2d& position_m) const {
    const Eigen::Vector2d along = (to_m - from_m).normalized();
    const Eigen::Vector2d offset = position_m - from_m;
    return {along.dot(offset), std::abs(along.x() * offset.y() - along.y() * offset.x())};
  }
  [[nodiscard]] double length_m() const { return (to_m - from_m).norm(); }
};

std::array<Wall, 4> walls_of(const RoomDescription& room) {
  const Eigen::Vector2d& a = room.min_m;
  const Eigen::Vector2d& c = room.max_m;
  const Eigen::Vector2d b(c.x(), a.y());
  const Eigen::Vector2d d(a.x(), c.y());
  return {Wall{a, b}, Wall{b, c}, Wall{c, d}, Wall{d, a}};
}

bool overlap(const RoomDescription& a, const RoomDescription& b) {
  const Eigen::Array2d shared = a.max_m.cwiseMin(b.max_m) - a.min_m.cwiseMax(b.min_m);
  return (shared > 0.01).all();
}

/// What keeps an opening out of all walls; empty where nothing does.
std::string complaint(const OpeningDescription& opening, const SceneDescription& scene) {
  std::string found = "is on no wall; put it within 0.3 m of one";
  for (const RoomDescription& room : scene.rooms) {
    for (const Wall& wall : walls_of(room)) {
      const Eigen::Vector2d at = wall.coordinates(opening.position_m);
      const bool is_along = at.x() >= 0.0 && at.x() <= wall.length_m();
      if (!is_along || at.y() > kWallReach) continue;
      const double half_m = 0.5 * opening.width_m;
      const bool fits = at.x() >= half_m + kCorner && at.x() + half_m <= wall.length_m() - kCorner;
      if (fits) return "";
      found = "leaves less than 0.11 m to the end of its wall; move it or make it narrower";
    }
  }
  return found;
}

void check_room(MapReader& reader, const SceneDescription& scene, const RoomDescription& room) {
  const Eigen::Array2d size = room.max_m - room.min_m;
  if ((size < 1.0).any() || (size > 200.0).any()) {
    reader.add_problem("max_m", "must be 1 to 200 m beyond min_m in x and y");
    return;
  }
  for (const RoomDescription& other : scene.rooms) {
    if (overlap(room, other)) {
      reader.add_problem("min_m",
                         "overlaps room \"" + other.name + "\"; rooms may touch, not overlap");
    }
    if (room.name == other.name) {
      reader.add_problem("name", "\"" + room.name + "\" is the name of another room");
    }
  }
}

std::vector<OpeningDescription> read_list(MapReader& root,
                                          const std::string& key,
                                          SceneContext& context,
                                          const SceneDescription& scene) {
  std::vector<OpeningDescription> openings;
  for (const ListItem& item : root.list(key)) {
    MapReader reader(item.node, item.path, context.problems);
    OpeningDescription opening;
    if (key == "windows") opening.width_m = 1.4;
    const bool complete = reader.require({"at_m"});
    reader.read("at_m", opening.position_m);
    reader.read("width_m", opening.width_m, {0.3, 10.0});
    if (key == "doors") {
      reader.read("open_deg", opening.open_deg, {0.0, 180.0});
      reader.read("leaf", opening.has_leaf);
    }
    reader.finish();
    const std::string what = scene.rooms.empty() ? "" : complaint(opening, scene);
    if (complete && !what.empty()) reader.add_problem("at_m", what);
    openings.push_back(opening);
  }
  return openings;
}

}  // namespace

bool is_in_a_room(const SceneDescription& scene,
                  const Eigen::Vector2d& position_m,
                  double margin_m) {
  const auto contains = [&](const RoomDescription& room) {
    const Eigen::Array2d beyond =
        (room.min_m - position_m).cwiseMax(position_m - room.max_m).array();
    return (beyond <= margin_m).all();
  };
  return scene.rooms.empty() || std::ranges::any_of(scene.rooms, contains);
}

void read_rooms(MapReader& root, SceneContext& context, SceneDescription& scene) {
  const std::vector<std::string>& surfaces = context.catalogue.surfaces;
  for (const ListItem& item : root.list("rooms")) {
    MapReader reader(item.node, item.path, context.problems);
    RoomDescription room;
    room.name = "room_" + std::to_string(scene.rooms.size() + 1);
    const bool complete = reader.require({"min_m", "max_m"});
    reader.read("name", room.name);
    reader.read("min_m", room.min_m);
    reader.read("max_m", room.max_m);
    reader.read("height_m", room.height_m, {2.0, 20.0});
    reader.read("floor", room.floor, surfaces);
    reader.read("walls", room.walls, surfaces);
    if (reader.has("wall_colour_rgb")) {
      Eigen::Vector3d colour = Eigen::Vector3d::Ones();
      reader.read("wall_colour_rgb", colour, {0.0, 1.0});
      room.wall_colour_rgb = colour;
    }
    reader.read("lamps", room.lamps, {0, 64});
    reader.read("brightness", room.brightness, {0.0, 10.0});
    reader.finish();
    if (!complete) continue;
    check_room(reader, scene, room);
    scene.rooms.push_back(std::move(room));
  }
}

void read_openings(MapReader& root, SceneContext& context, SceneDescription& scene) {
  scene.doors = read_list(root, "doors", context, scene);
  scene.windows = read_list(root, "windows", context, scene);
}

}  // namespace tsg
