#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/geometry/se3.hpp"
#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/scene.hpp"

namespace tsg::simulation {

/// A room's rectangle runs along the middle of its walls: their faces stand half of this inside.
inline constexpr double kWallThickness = 0.12;

/// A rectangle cut into a wall, in the wall's axes.
struct Hole {
  float left_m = 0.0F;
  float right_m = 0.0F;
  float bottom_m = 0.0F;
  float top_m = 0.0F;
  std::size_t opening = 0;  ///< index into the scene's doors or windows
  bool is_door = false;
};

/// The inner face of one side of a room. Its axes: x points into the room, y to the right of who
/// looks at it, z up; origin at the floor in its left corner.
struct Wall {
  std::size_t room = 0;
  SE3 T_world_wall;
  float width_m = 0.0F;
  float height_m = 0.0F;
  std::vector<Hole> holes;
};

/// The four walls of every room, with all holes of the scene's doors and windows cut.
[[nodiscard]] std::vector<Wall> make_walls(const SceneDescription& scene);

/// The wall's sheet around its holes; uv in metres.
[[nodiscard]] render::Mesh make_wall_sheet(const Wall& wall, const render::Material& material);

/// From `wall` through its hole to the face of the wall behind it; nothing where the hole leads out
/// of the building.
[[nodiscard]] std::optional<float> depth_through(const Wall& wall,
                                                 const Hole& hole,
                                                 const std::vector<Wall>& walls);

/// Skirting between the doors, light switches beside them, sockets.
void add_wall_fittings(Assembly& parts, const Wall& wall);

}  // namespace tsg::simulation
