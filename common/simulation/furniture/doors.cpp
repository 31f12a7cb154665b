#include <cmath>
#include <numbers>

#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/openings.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation {
namespace {

using Eigen::Vector3f;

constexpr float kArchitrave = 0.07F;
constexpr float kLining = 0.025F;
constexpr float kLeaf = 0.04F;

render::Material frame_paint() { return materials::plain({188, 196, 200}, 0.25F); }

/// The flat boards around the hole on the face of a wall, in the wall's axes.
void add_architrave(Assembly& parts, const Hole& hole) {
  const render::Material paint = frame_paint();
  constexpr float kThick = 0.016F;
  const float outer = hole.top_m + kArchitrave;
  for (const float y : {hole.left_m - 0.5F * kArchitrave, hole.right_m + 0.5F * kArchitrave}) {
    parts.box({kThick, kArchitrave, outer}, {0.5F * kThick, y, 0.0F}, paint);
  }
  parts.box({kThick, hole.right_m - hole.left_m, kArchitrave},
            {0.5F * kThick, 0.5F * (hole.left_m + hole.right_m), hole.top_m}, paint);
}

/// Boards that cover the cut through the wall, `depth_m` deep, and the threshold.
void add_lining(Assembly& parts, const Hole& hole, float depth_m) {
  const render::Material paint = frame_paint();
  const float x = -0.5F * depth_m;
  const float width = hole.right_m - hole.left_m;
  const float middle = 0.5F * (hole.left_m + hole.right_m);
  // They stand out of the wall's faces by a hair, lest both lie in one plane.
  const float deep = depth_m + 0.004F;
  for (const float y : {hole.left_m + 0.5F * kLining, hole.right_m - 0.5F * kLining}) {
    parts.box({deep, kLining, hole.top_m}, {x, y, 0.0F}, paint);
  }
  parts.box({deep, width - 2.0F * kLining, kLining}, {x, middle, hole.top_m - kLining}, paint);
  parts.box({depth_m + 0.03F, width - 2.0F * kLining, 0.02F}, {x, middle, -0.012F},
            materials::plain({105, 110, 115}, 0.5F));
}

void add_handle(Assembly& leaf, float y, float side) {
  const render::Material steel = materials::chrome();
  const float face = side > 0.0F ? 0.0F : -kLeaf;
  constexpr float kHeight = 1.03F;
  leaf.box({0.008F, 0.04F, 0.2F}, {face + side * 0.004F, y, kHeight - 0.13F}, steel);
  leaf.pipe({{face, y, kHeight},
             {face + side * 0.045F, y, kHeight},
             {face + side * 0.052F, y - 0.02F, kHeight},
             {face + side * 0.05F, y - 0.12F, kHeight}},
            0.009F, steel);
}

}  // namespace

/// Two thin panels in a frame of posts and rails.
render::Mesh make_leaf(float width_m, float height_m, Random& random) {
  const render::Material board = random.chance(0.5)
                                     ? materials::wood(textures::Wood::kBeech, random)
                                     : materials::plain({206, 212, 215}, 0.25F);
  constexpr float kPost = 0.12F;
  const float x = -0.5F * kLeaf;
  const float middle = 0.5F * width_m;
  const float inner = width_m - 2.0F * kPost;
  Assembly leaf;
  for (const float y : {0.5F * kPost, width_m - 0.5F * kPost}) {
    leaf.box({kLeaf, kPost, height_m}, {x, y, 0.0F}, board);
  }
  leaf.box({kLeaf, inner, 0.2F}, {x, middle, 0.0F}, board);
  leaf.box({kLeaf, inner, 0.16F}, {x, middle, 0.9F}, board);
  leaf.box({kLeaf, inner, kPost}, {x, middle, height_m - kPost}, board);
  leaf.box({0.6F * kLeaf, inner, 0.7F}, {x, middle, 0.2F}, board);
  leaf.box({0.6F * kLeaf, inner, height_m - kPost - 1.06F}, {x, middle, 1.06F}, board);
  for (const float side : {-1.0F, 1.0F}) add_handle(leaf, width_m - 0.06F, side);
  render::Mesh plate = render::make_picture(
      0.2F, 0.1F, materials::pictured(textures::label({232, 236, 238}, random), 1.0, 0.3F));
  leaf.add(plate, placed({-0.2F * kLeaf + 0.003F, middle, 1.52F}));
  return leaf.finished();
}

FurnitureModel pieces::door_leaf(Random& random) {
  constexpr float kWidth = 0.84F;
  constexpr float kHeight = 2.0F;
  Assembly parts;
  parts.add(make_leaf(kWidth, kHeight, random));
  // Both faces have been hung with a poster and notices, which cover the panels.
  for (const float side : {1.0F, -1.0F}) {
    const float face = side > 0.0F ? 0.002F : -kLeaf - 0.002F;
    const double yaw = side > 0.0F ? 0.0 : std::numbers::pi;
    parts.add(
        render::make_picture(0.64F, 0.86F, materials::pictured(textures::poster(random), 1.0)),
        placed({face, 0.5F * kWidth, 1.04F}, yaw));
    parts.add(render::make_picture(0.64F, 0.74F,
                                   materials::pictured(textures::pinned_papers(random), 1.0)),
              placed({face, 0.5F * kWidth, 0.18F}, yaw));
  }
  FurnitureModel model;
  model.class_name = "door";
  model.mesh = parts.finished();
  return model;
}

namespace {

/// Lining and leaf in the wall's axes; a door without `depth` leads nowhere.
render::Mesh make_door(const SceneDescription& scene,
                       const Hole& hole,
                       const std::optional<float>& depth) {
  const OpeningDescription& opening = scene.doors[hole.opening];
  Assembly door;
  add_lining(door, hole, depth.value_or(static_cast<float>(kWallThickness)));
  if (!opening.has_leaf) return door.finished();
  Random random(seed_of(scene.seed, "door " + std::to_string(hole.opening)));
  const float width = hole.right_m - hole.left_m - 2.0F * kLining - 0.006F;
  const double open_rad = depth ? opening.open_deg * std::numbers::pi / 180.0 : 0.0;
  door.add(make_leaf(width, hole.top_m - kLining - 0.018F, random),
           placed({-0.004F, hole.left_m + kLining + 0.003F, 0.012F}, -open_rad));
  return door.finished();
}

}  // namespace

void add_doors(Assembly& parts, const SceneDescription& scene, const std::vector<Wall>& walls) {
  std::vector<const Wall*> first_of(scene.doors.size(), nullptr);
  for (const Wall& wall : walls) {
    for (const Hole& hole : wall.holes) {
      if (!hole.is_door) continue;
      Assembly face;
      add_architrave(face, hole);
      parts.add(face.finished(), wall.T_world_wall);
      if (first_of[hole.opening] == nullptr) first_of[hole.opening] = &wall;
    }
  }
  for (const Wall& wall : walls) {
    for (const Hole& hole : wall.holes) {
      if (!hole.is_door || first_of[hole.opening] != &wall) continue;
      parts.add(make_door(scene, hole, depth_through(wall, hole, walls)), wall.T_world_wall);
    }
  }
}

}  // namespace tsg::simulation
