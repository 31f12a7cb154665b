#include "common/simulation/furniture/ceiling.hpp"

#include <algorithm>
#include <cmath>

#include "common/simulation/furniture/materials.hpp"

namespace tsg::simulation {
namespace {

using Eigen::Vector3f;

constexpr float kPanel = 0.6F;  // side of a lamp
/// Radiance of lamps that together are as big as the floor and make it white at brightness 1.
constexpr double kFullCeilingRadiance = 1.1;

/// Places for `count` lamps in rows along the longer side, each amid its share of the ceiling.
std::vector<Eigen::Vector2d> lamp_places(const RoomDescription& room) {
  const Eigen::Vector2d size = room.max_m - room.min_m;
  const bool is_along_x = size.x() >= size.y();
  const double length = is_along_x ? size.x() : size.y();
  const double width = is_along_x ? size.y() : size.x();
  const int rows = std::clamp(static_cast<int>(std::lround(std::sqrt(room.lamps * width / length))),
                              1, std::max(1, room.lamps));
  std::vector<Eigen::Vector2d> places;
  for (int row = 0; row < rows; ++row) {
    const int in_row = room.lamps * (row + 1) / rows - room.lamps * row / rows;
    for (int i = 0; i < in_row; ++i) {
      const double along = length * (i + 0.5) / in_row;
      const double across = width * (row + 0.5) / rows;
      places.emplace_back(room.min_m + (is_along_x ? Eigen::Vector2d(along, across)
                                                   : Eigen::Vector2d(across, along)));
    }
  }
  return places;
}

/// A lit pane in a white frame, let into the ceiling at z.
void add_panel(Assembly& parts, const Vector3f& at) {
  constexpr float kRim = 0.025F;
  constexpr float kDepth = 0.014F;
  const render::Material rim = materials::plain({225, 228, 230}, 0.2F);
  const Vector3f base = at - Vector3f(0.0F, 0.0F, kDepth);
  for (const float side : {-1.0F, 1.0F}) {
    const float offset = side * 0.5F * (kPanel - kRim);
    parts.box({kRim, kPanel, kDepth}, base + Vector3f(offset, 0.0F, 0.0F), rim);
    parts.box({kPanel - 2.0F * kRim, kRim, kDepth}, base + Vector3f(0.0F, offset, 0.0F), rim);
  }
  const float inner = kPanel - 2.0F * kRim;
  parts.box({inner, inner, 0.004F}, at - Vector3f(0.0F, 0.0F, 0.009F),
            materials::glowing({250, 252, 255}, 1.6F));
}

/// A round glass under the ceiling.
void add_bowl(Assembly& parts, const Vector3f& at) {
  constexpr float kRadius = 0.26F;
  constexpr float kDepth = 0.09F;
  parts.turned({{{0.001F, -kDepth},
                 {0.5F * kRadius, -0.9F * kDepth},
                 {0.85F * kRadius, -0.6F * kDepth},
                 {kRadius, -0.2F * kDepth}}},
               at, materials::glowing({225, 242, 252}, 1.5F), 28);
  parts.turned(
      {{{kRadius, -0.2F * kDepth}, {1.03F * kRadius, -0.18F * kDepth}, {1.03F * kRadius, 0.0F}}},
      at, materials::chrome(), 28);
}

Lamp make_lamp(const Vector3f& at, double radiance) {
  Lamp lamp;
  lamp.centre_m = at;
  lamp.half_side_a_m = {0.5F * kPanel, 0.0F, 0.0F};
  lamp.half_side_b_m = {0.0F, 0.5F * kPanel, 0.0F};
  lamp.normal = -Vector3f::UnitZ();
  lamp.radiance_bgr = static_cast<float>(radiance) * Vector3f(0.93F, 0.98F, 1.0F);
  return lamp;
}

}  // namespace

void add_ceiling(Building& building,
                 Assembly& parts,
                 const RoomDescription& room,
                 std::uint64_t seed) {
  Random random(seed_of(seed, "ceiling " + room.name));
  const bool is_plastered = room.walls == "wallpaper";
  const render::Material material =
      is_plastered ? materials::pictured(textures::plaster({232, 236, 238}, random), 4.0, 0.0F)
                   : materials::pictured(textures::ceiling_tiles(random), 2.4, 0.0F);
  const Eigen::Vector2f size = (room.max_m - room.min_m).cast<float>();
  const Eigen::Vector2f centre = (0.5 * (room.min_m + room.max_m)).cast<float>();
  const auto height = static_cast<float>(room.height_m);
  constexpr float kSlab = 0.02F;
  parts.box({size.x(), size.y(), kSlab}, {centre.x(), centre.y(), height}, material);
  const double area = static_cast<double>(size.x()) * static_cast<double>(size.y());
  const double radiance = room.lamps == 0 ? 0.0
                                          : room.brightness * kFullCeilingRadiance * area /
                                                (room.lamps * double{kPanel} * double{kPanel});
  for (const Eigen::Vector2d& place : lamp_places(room)) {
    const Vector3f at(static_cast<float>(place.x()), static_cast<float>(place.y()), height);
    if (is_plastered) {
      add_bowl(parts, at);
    } else {
      add_panel(parts, at);
    }
    building.lamps.push_back(make_lamp(at - Vector3f(0.0F, 0.0F, 0.1F), radiance));
  }
}

}  // namespace tsg::simulation
