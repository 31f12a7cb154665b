#include "common/simulation/furniture/room.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/ceiling.hpp"
#include "common/simulation/furniture/openings.hpp"
#include "common/simulation/furniture/surfaces.hpp"
#include "common/simulation/furniture/wall.hpp"

namespace tsg::simulation {
namespace {

/// Makes each surface once for all rooms that have it: their pictures are big.
class SurfaceStore {
 public:
  explicit SurfaceStore(std::uint64_t seed) : seed_(seed) {}

  const render::Material& get(const std::string& name, const std::optional<paint::Colour>& colour) {
    std::string key = name;
    for (int i = 0; i < 3 && colour; ++i) key += ' ' + std::to_string((*colour)[i]);
    const auto known = made_.find(key);
    if (known != made_.end()) return known->second;
    return made_.emplace(key, make_surface(name, colour, seed_)).first->second;
  }

 private:
  std::uint64_t seed_;
  std::map<std::string, render::Material> made_;
};

std::optional<paint::Colour> wall_colour(const RoomDescription& room) {
  if (!room.wall_colour_rgb) return std::nullopt;
  const Eigen::Vector3d codes = 255.0 * *room.wall_colour_rgb;
  return paint::Colour(codes.z(), codes.y(), codes.x());
}

/// A slab whose upper face is z = 0; its uv is that of the world, so that floors of neighbouring
/// rooms are laid in one.
render::Mesh make_floor(const RoomDescription& room, const render::Material& material) {
  const Eigen::Vector2f size = (room.max_m - room.min_m).cast<float>();
  const Eigen::Vector2f centre = (0.5 * (room.min_m + room.max_m)).cast<float>();
  constexpr float kSlab = 0.02F;
  render::Mesh floor;
  floor.append(render::make_box({size.x(), size.y(), kSlab}, material),
               placed({centre.x(), centre.y(), -kSlab}));
  for (std::size_t i = 0; i < floor.points.size(); ++i) {
    if (floor.normals[i].z() > 0.5F) floor.uvs[i] = {floor.points[i].x(), -floor.points[i].y()};
  }
  return floor;
}

}  // namespace

Building make_building(const SceneDescription& scene) {
  Building building;
  Assembly parts;
  SurfaceStore surfaces(scene.seed);
  const std::vector<Wall> walls = make_walls(scene);
  for (const Wall& wall : walls) {
    const RoomDescription& room = scene.rooms[wall.room];
    parts.add(make_wall_sheet(wall, surfaces.get(room.walls, wall_colour(room))),
              wall.T_world_wall);
    add_wall_fittings(parts, wall);
  }
  for (const RoomDescription& room : scene.rooms) {
    parts.add(make_floor(room, surfaces.get(room.floor, std::nullopt)));
    add_ceiling(building, parts, room, scene.seed);
  }
  add_doors(parts, scene, walls);
  add_windows(building, parts, walls, scene.seed);
  building.shell = parts.finished();
  return building;
}

}  // namespace tsg::simulation
