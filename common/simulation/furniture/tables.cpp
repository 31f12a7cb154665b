#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

FurnitureModel table_of(const Assembly& parts, float top_m) {
  FurnitureModel model;
  model.class_name = "dining table";
  model.mesh = parts.finished();
  model.top_m = top_m;
  model.grip_height_m = top_m;
  return model;
}

/// Four square legs inside of `size`, up to `height_m`.
void add_legs(Assembly& parts,
              const Eigen::Vector2f& size_m,
              float height_m,
              float leg_m,
              const render::Material& material) {
  for (const float side_x : {-1.0F, 1.0F}) {
    for (const float side_y : {-1.0F, 1.0F}) {
      const Vector3f at(side_x * (0.5F * size_m.x() - leg_m), side_y * (0.5F * size_m.y() - leg_m),
                        0.0F);
      parts.box({leg_m, leg_m, height_m}, at, material);
    }
  }
}

/// Bars just under the top, from leg to leg.
void add_apron(Assembly& parts,
               const Eigen::Vector2f& size_m,
               float top_m,
               float height_m,
               const render::Material& material) {
  const float x = 0.5F * size_m.x() - 0.06F;
  const float y = 0.5F * size_m.y() - 0.06F;
  for (const float side : {-1.0F, 1.0F}) {
    parts.box({0.022F, 2.0F * y, height_m}, {side * x, 0.0F, top_m - height_m}, material);
    parts.box({2.0F * x, 0.022F, height_m}, {0.0F, side * y, top_m - height_m}, material);
  }
}

/// Two drawers under a desk's top, with fronts and handles towards +x.
void add_drawers(Assembly& parts, float y, float top_m, const render::Material& body) {
  constexpr float kDepth = 0.5F;
  constexpr float kWidth = 0.4F;
  constexpr float kHeight = 0.16F;
  const render::Material handle = materials::chrome();
  for (int i = 0; i < 3; ++i) {
    const float z = top_m - kHeight * static_cast<float>(i + 1) - 0.004F;
    parts.box({kDepth, kWidth, kHeight - 0.006F}, {0.02F, y, z}, body);
    parts.box({0.018F, kWidth - 0.012F, kHeight - 0.018F}, {0.275F, y, z + 0.005F}, body);
    const float handle_z = z + 0.6F * kHeight;
    parts.pipe({{0.28F, y - 0.07F, handle_z},
                {0.305F, y - 0.06F, handle_z},
                {0.305F, y + 0.06F, handle_z},
                {0.28F, y + 0.07F, handle_z}},
               0.005F, handle);
  }
}

/// A black grommet with cables that hang down behind the desk.
void add_cables(Assembly& parts, const Eigen::Vector2f& size_m, float top_m, Random& random) {
  const render::Material rubber = materials::dark_plastic();
  const float x = -0.5F * size_m.x() + 0.09F;
  const float y = static_cast<float>(random.uniform(-0.25, 0.25)) * size_m.y();
  parts.turned({{{0.0F, 0.0F}, {0.035F, 0.0F}, {0.03F, 0.003F}, {0.0F, 0.003F}}}, {x, y, top_m},
               rubber, 14);
  for (int i = 0; i < 3; ++i) {
    const float sway = 0.06F * static_cast<float>(random.normal());
    parts.pipe({{x, y, top_m - 0.03F},
                {x - 0.01F, y + sway, top_m - 0.25F},
                {x - 0.03F, y - sway, top_m - 0.5F},
                {x, y + sway, 0.006F},
                {x + 0.08F, y + 2.0F * sway, 0.006F}},
               0.004F, rubber);
  }
}

}  // namespace

FurnitureModel desk(Random& random) {
  const Eigen::Vector2f size(0.8F, static_cast<float>(random.uniform(1.5, 1.7)));
  const auto top = static_cast<float>(random.uniform(0.72, 0.75));
  constexpr float kBoard = 0.026F;
  const render::Material board = materials::any_wood(random);
  const render::Material steel =
      materials::metal(paint::scaled({205, 206, 207}, random.chance(0.5) ? 1.0 : 0.25), random);
  Assembly parts;
  parts.box({size.x(), size.y(), kBoard}, {0.0F, 0.0F, top - kBoard}, board);
  for (const float side : {-1.0F, 1.0F}) {
    const float y = side * (0.5F * size.y() - 0.08F);
    parts.box({0.68F, 0.07F, 0.025F}, {0.0F, y, 0.0F}, steel);
    parts.box({0.07F, 0.05F, top - kBoard - 0.05F}, {-0.05F, y, 0.025F}, steel);
    parts.box({0.68F, 0.05F, 0.025F}, {0.0F, y, top - kBoard - 0.025F}, steel);
  }
  parts.box({0.016F, size.y() - 0.3F, 0.34F}, {-0.3F, 0.0F, top - kBoard - 0.36F}, board);
  add_drawers(parts, 0.5F * size.y() - 0.34F, top - kBoard, board);
  add_cables(parts, size, top, random);
  return table_of(parts, top);
}

FurnitureModel dining_table(Random& random) {
  const Eigen::Vector2f size(static_cast<float>(random.uniform(0.85, 0.95)),
                             static_cast<float>(random.uniform(1.5, 1.8)));
  constexpr float kTop = 0.75F;
  constexpr float kBoard = 0.032F;
  const render::Material wood = materials::any_wood(random);
  Assembly parts;
  parts.box({size.x(), size.y(), kBoard}, {0.0F, 0.0F, kTop - kBoard}, wood);
  add_legs(parts, size, kTop - kBoard, 0.07F, wood);
  add_apron(parts, size, kTop - kBoard, 0.09F, wood);
  return table_of(parts, kTop);
}

FurnitureModel round_table(Random& random) {
  constexpr float kTop = 0.74F;
  const auto radius = static_cast<float>(random.uniform(0.45, 0.6));
  const render::Material edge = materials::any_wood(random);
  const render::Material steel = materials::plain({95, 95, 97}, 0.4F);
  Assembly parts;
  parts.turned({{{0.0F, kTop - 0.028F}, {radius - 0.01F, kTop - 0.028F}},
                {{radius - 0.01F, kTop - 0.028F},
                 {radius, kTop - 0.02F},
                 {radius, kTop - 0.008F},
                 {radius - 0.006F, kTop}}},
               Vector3f::Zero(), edge, 40);
  parts.add(render::make_disc(radius - 0.006F, 40, edge), placed({0.0F, 0.0F, kTop}));
  parts.turned({{{0.0F, 0.0F}, {0.28F, 0.0F}},
                {{0.28F, 0.0F}, {0.28F, 0.012F}, {0.06F, 0.035F}, {0.035F, 0.06F}},
                {{0.035F, 0.06F}, {0.035F, kTop - 0.06F}},
                {{0.035F, kTop - 0.06F}, {0.16F, kTop - 0.03F}}},
               Vector3f::Zero(), steel, 24);
  return table_of(parts, kTop);
}

FurnitureModel coffee_table(Random& random) {
  const Eigen::Vector2f size(0.6F, static_cast<float>(random.uniform(0.95, 1.15)));
  const auto top = static_cast<float>(random.uniform(0.4, 0.46));
  const render::Material wood = materials::any_wood(random);
  Assembly parts;
  parts.box({size.x(), size.y(), 0.035F}, {0.0F, 0.0F, top - 0.035F}, wood);
  parts.box({size.x() - 0.12F, size.y() - 0.12F, 0.02F}, {0.0F, 0.0F, 0.13F}, wood);
  add_legs(parts, size, top - 0.035F, 0.06F, wood);
  // Magazines on the lower board.
  for (int i = 0; i < 3; ++i) {
    const render::Material cover = materials::pictured(textures::newspaper(random), 0.29);
    parts.box({0.29F, 0.22F, 0.012F},
              {0.03F * static_cast<float>(i), 0.1F * static_cast<float>(i - 1),
               0.15F + 0.0125F * static_cast<float>(i)},
              cover, random.uniform(-0.5, 0.5));
  }
  return table_of(parts, top);
}

}  // namespace tsg::simulation::pieces
