#include "common/simulation/furniture/wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/simulation/furniture/materials.hpp"

namespace tsg::simulation {
namespace {

using Eigen::Vector3f;

constexpr double kReach = 0.3;  // from an opening to the walls it is cut into
constexpr float kDoorHeight = 2.05F;
constexpr float kSillHeight = 0.9F;
constexpr float kWindowTop = 2.25F;
constexpr float kLintel = 0.2F;   // what is left of a wall above an opening, at least
constexpr float kPillar = 0.05F;  // and beside it

/// A wall that looks along `normal` from the rectangle's corner on its left.
Wall make_wall(std::size_t index, const RoomDescription& room, const Eigen::Vector2d& normal) {
  const Eigen::Vector2d centre = 0.5 * (room.min_m + room.max_m);
  const Eigen::Vector2d half =
      0.5 * (room.max_m - room.min_m) - Eigen::Vector2d::Constant(0.5 * kWallThickness);
  const Eigen::Vector2d right(-normal.y(), normal.x());
  const Eigen::Vector2d corner = centre - (normal + right).cwiseProduct(half);
  Wall wall;
  wall.room = index;
  wall.T_world_wall =
      placed(Vector3f(static_cast<float>(corner.x()), static_cast<float>(corner.y()), 0.0F),
             std::atan2(normal.y(), normal.x()));
  wall.width_m = static_cast<float>(2.0 * right.cwiseAbs().dot(half));
  wall.height_m = static_cast<float>(room.height_m);
  return wall;
}

void cut(Wall& wall, const OpeningDescription& opening, Hole hole) {
  const Eigen::Vector3d at = wall.T_world_wall.inverse() *
                             Eigen::Vector3d(opening.position_m.x(), opening.position_m.y(), 0.0);
  const double half = 0.5 * opening.width_m;
  hole.left_m = static_cast<float>(at.y() - half);
  hole.right_m = static_cast<float>(at.y() + half);
  hole.top_m = std::min(hole.top_m, wall.height_m - kLintel);
  const bool fits = hole.left_m >= kPillar && hole.right_m <= wall.width_m - kPillar;
  if (std::abs(at.x()) <= kReach && fits) wall.holes.push_back(hole);
}

std::vector<float> sorted(std::vector<float> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

bool is_in_hole(const Wall& wall, float y, float z) {
  return std::any_of(wall.holes.begin(), wall.holes.end(), [&](const Hole& hole) {
    return y > hole.left_m && y < hole.right_m && z > hole.bottom_m && z < hole.top_m;
  });
}

void add_face(render::Mesh& mesh, const Eigen::Vector2f& low, const Eigen::Vector2f& high) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const Eigen::Vector2f& corner :
       {low, Eigen::Vector2f(high.x(), low.y()), high, Eigen::Vector2f(low.x(), high.y())}) {
    mesh.points.emplace_back(0.0F, corner.x(), corner.y());
    mesh.normals.emplace_back(Vector3f::UnitX());
    mesh.uvs.emplace_back(corner.x(), -corner.y());
  }
  mesh.triangles.push_back({{first, first + 1, first + 2}, 0});
  mesh.triangles.push_back({{first, first + 2, first + 3}, 0});
}

/// A plate on the wall with a rocker or the two holes of a socket.
void add_plate(Assembly& parts, const Vector3f& at, bool is_socket) {
  const render::Material white = materials::plain({232, 236, 238}, 0.3F);
  parts.cushion({0.01F, 0.082F, 0.082F}, placed(at + Vector3f(0.005F, 0.0F, 0.0F)), 0.004F, white);
  if (!is_socket) {
    parts.add(render::make_box({0.008F, 0.05F, 0.05F}, white),
              tilted(at + Vector3f(0.009F, 0.0F, 0.016F), 0.06));
    return;
  }
  const render::Material dark = materials::plain({40, 40, 40}, 0.0F);
  parts.cushion({0.004F, 0.05F, 0.05F}, placed(at + Vector3f(0.0095F, 0.0F, 0.016F)), 0.002F,
                materials::plain({200, 204, 206}, 0.2F));
  for (const float side : {-0.01F, 0.01F}) {
    parts.box({0.002F, 0.006F, 0.006F}, at + Vector3f(0.012F, side, 0.038F), dark);
  }
}

void add_skirting(Assembly& parts, float from, float to) {
  if (to - from < 0.02F) return;
  parts.box({0.014F, to - from, 0.075F}, {0.007F, 0.5F * (from + to), 0.0F},
            materials::plain({196, 204, 208}, 0.15F));
}

}  // namespace

std::vector<Wall> make_walls(const SceneDescription& scene) {
  std::vector<Wall> walls;
  for (std::size_t room = 0; room < scene.rooms.size(); ++room) {
    for (const auto& [x, y] :
         std::array<std::array<double, 2>, 4>{{{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}}}) {
      walls.push_back(make_wall(room, scene.rooms[room], {x, y}));
    }
  }
  for (Wall& wall : walls) {
    for (std::size_t i = 0; i < scene.doors.size(); ++i) {
      cut(wall, scene.doors[i],
          {.bottom_m = 0.0F, .top_m = kDoorHeight, .opening = i, .is_door = true});
    }
    for (std::size_t i = 0; i < scene.windows.size(); ++i) {
      cut(wall, scene.windows[i], {.bottom_m = kSillHeight, .top_m = kWindowTop, .opening = i});
    }
  }
  return walls;
}

render::Mesh make_wall_sheet(const Wall& wall, const render::Material& material) {
  std::vector<float> ys = {0.0F, wall.width_m};
  std::vector<float> zs = {0.0F, wall.height_m};
  for (const Hole& hole : wall.holes) {
    ys.insert(ys.end(), {hole.left_m, hole.right_m});
    zs.insert(zs.end(), {hole.bottom_m, hole.top_m});
  }
  ys = sorted(ys);
  zs = sorted(zs);
  render::Mesh mesh;
  mesh.materials.push_back(material);
  for (std::size_t i = 0; i + 1 < ys.size(); ++i) {
    for (std::size_t k = 0; k + 1 < zs.size(); ++k) {
      if (is_in_hole(wall, 0.5F * (ys[i] + ys[i + 1]), 0.5F * (zs[k] + zs[k + 1]))) continue;
      add_face(mesh, {ys[i], zs[k]}, {ys[i + 1], zs[k + 1]});
    }
  }
  return mesh;
}

std::optional<float> depth_through(const Wall& wall,
                                   const Hole& hole,
                                   const std::vector<Wall>& walls) {
  for (const Wall& other : walls) {
    if (other.room == wall.room) continue;
    const bool is_same_opening =
        std::any_of(other.holes.begin(), other.holes.end(), [&](const Hole& candidate) {
          return candidate.is_door == hole.is_door && candidate.opening == hole.opening;
        });
    if (!is_same_opening) continue;
    const Eigen::Vector3d behind = wall.T_world_wall.inverse() * other.T_world_wall.translation();
    return static_cast<float>(-behind.x());
  }
  return std::nullopt;
}

void add_wall_fittings(Assembly& parts, const Wall& wall) {
  constexpr float kArchitrave = 0.07F;
  constexpr float kSocketPitch = 2.3F;
  Assembly fittings;
  std::vector<Hole> doors;
  std::copy_if(wall.holes.begin(), wall.holes.end(), std::back_inserter(doors),
               [](const Hole& hole) { return hole.is_door; });
  std::sort(doors.begin(), doors.end(),
            [](const Hole& a, const Hole& b) { return a.left_m < b.left_m; });
  float from = 0.0F;
  for (const Hole& door : doors) {
    add_skirting(fittings, from, door.left_m - kArchitrave);
    from = door.right_m + kArchitrave;
    const float y = door.right_m + 0.2F;
    if (y < wall.width_m - 0.1F) add_plate(fittings, {0.0F, y, 1.05F}, false);
  }
  add_skirting(fittings, from, wall.width_m);
  const auto sockets = static_cast<int>(std::ceil((wall.width_m - 1.0F) / kSocketPitch));
  for (int i = 0; i < sockets; ++i) {
    const float y = 0.7F + kSocketPitch * static_cast<float>(i);
    const bool is_free = std::none_of(doors.begin(), doors.end(), [&](const Hole& door) {
      return y > door.left_m - 0.15F && y < door.right_m + 0.15F;
    });
    if (is_free) add_plate(fittings, {0.0F, y, 0.26F}, true);
  }
  parts.add(fittings.finished(), wall.T_world_wall);
}

}  // namespace tsg::simulation
