#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

FurnitureModel appliance(const std::string& class_name, const Assembly& parts, double top_m) {
  FurnitureModel model;
  model.class_name = class_name;
  model.mesh = parts.finished();
  model.top_m = top_m;
  return model;
}

void add_bar_handle(Assembly& parts, const Vector3f& at, const Vector3f& half_m) {
  const Vector3f out(0.035F, 0.0F, 0.0F);
  parts.pipe({at - half_m, at - 0.95F * half_m + out, at + 0.95F * half_m + out, at + half_m},
             0.009F, materials::chrome());
}

/// A basin sunk into a worktop: four walls and a floor, seen from above.
void add_basin(Assembly& parts, const Eigen::Vector2f& size_m, const Vector3f& rim) {
  const render::Material steel = materials::plain({176, 178, 180}, 0.7F);
  constexpr float kDeep = 0.16F;
  constexpr float kSheet = 0.006F;
  parts.box({size_m.x(), size_m.y(), kSheet}, rim - Vector3f(0.0F, 0.0F, kDeep), steel);
  for (const float side : {-1.0F, 1.0F}) {
    parts.box({kSheet, size_m.y(), kDeep + 0.004F},
              rim + Vector3f(side * 0.5F * size_m.x(), 0.0F, -kDeep), steel);
    parts.box({size_m.x(), kSheet, kDeep + 0.004F},
              rim + Vector3f(0.0F, side * 0.5F * size_m.y(), -kDeep), steel);
  }
  parts.add(render::make_disc(0.035F, 16, materials::plain({60, 60, 62}, 0.5F)),
            placed(rim + Vector3f(0.0F, 0.0F, -kDeep + kSheet + 0.001F)));
}

/// A worktop with a hole for the basin: four boards around it.
void add_worktop(Assembly& parts,
                 const Vector3f& size_m,
                 const Eigen::Vector4f& hole,
                 float top_m,
                 const render::Material& material) {
  const float z = top_m - size_m.z();
  const float x0 = -0.5F * size_m.x();
  const float y0 = -0.5F * size_m.y();
  const float x1 = -x0;
  const float y1 = -y0;
  const auto board = [&](float from_x, float to_x, float from_y, float to_y) {
    parts.box({to_x - from_x, to_y - from_y, size_m.z()},
              {0.5F * (from_x + to_x), 0.5F * (from_y + to_y), z}, material);
  };
  board(x0, hole[0], y0, y1);
  board(hole[1], x1, y0, y1);
  board(hole[0], hole[1], y0, hole[2]);
  board(hole[0], hole[1], hole[3], y1);
}

}  // namespace

FurnitureModel fridge(Random& random) {
  const auto height = static_cast<float>(random.uniform(1.65, 1.85));
  const bool is_steel = random.chance(0.5);
  const render::Material front = is_steel ? materials::metal({178, 180, 182}, random)
                                          : materials::plain({230, 234, 236}, 0.4F);
  Assembly parts;
  parts.box({0.6F, 0.58F, 0.05F}, {-0.02F, 0.0F, 0.0F}, materials::dark_plastic());
  parts.box({0.58F, 0.6F, height - 0.05F}, {-0.03F, 0.0F, 0.05F}, front);
  const float split = 0.38F * height;
  const float x = 0.29F;
  parts.cushion({0.06F, 0.598F, split - 0.066F}, placed({x, 0.0F, 0.06F}), 0.012F, front);
  parts.cushion({0.06F, 0.598F, height - split - 0.004F}, placed({x, 0.0F, split}), 0.012F, front);
  add_bar_handle(parts, {0.318F, 0.24F, split - 0.2F}, {0.0F, 0.0F, 0.14F});
  add_bar_handle(parts, {0.318F, 0.24F, split + 0.3F}, {0.0F, 0.0F, 0.22F});
  // Magnets and notes.
  const int notes = random.integer(3, 6);
  for (int i = 0; i < notes; ++i) {
    const Vector3f at(
        0.321F + 0.0006F * static_cast<float>(i), static_cast<float>(random.uniform(-0.2, 0.12)),
        split + static_cast<float>(random.uniform(0.15, 0.85)) * (height - split - 0.25F));
    const render::Material note = materials::pictured(textures::newspaper(random), 1.0, 0.0F);
    parts.add(render::make_picture(0.1F, 0.13F, note), placed(at));
    parts.box({0.008F, 0.022F, 0.022F}, at + Vector3f(0.004F, 0.0F, 0.11F),
              materials::plain(paint::any_colour(random), 0.3F));
  }
  return appliance("refrigerator", parts, height);
}

FurnitureModel sink_unit(Random& random) {
  constexpr float kTop = 0.91F;
  constexpr float kWidth = 1.2F;
  constexpr float kDepth = 0.6F;
  const render::Material front = materials::plain(
      paint::between(materials::upholstery_colour(random), {225, 230, 232}, 0.6), 0.25F);
  const render::Material stone =
      materials::pictured(textures::linoleum({110, 115, 120}, random), 1.0, 0.4F);
  Assembly parts;
  parts.box({kDepth - 0.08F, kWidth, 0.1F}, {-0.03F, 0.0F, 0.0F}, materials::dark_plastic());
  parts.box({kDepth - 0.05F, kWidth, kTop - 0.3F}, {-0.02F, 0.0F, 0.1F}, front);
  for (int i = 0; i < 2; ++i) {
    const float y = (static_cast<float>(i) - 0.5F) * 0.5F * kWidth;
    parts.box({0.018F, 0.5F * kWidth - 0.008F, kTop - 0.16F}, {0.265F, y, 0.105F}, front);
    add_bar_handle(parts, {0.274F, y, kTop - 0.14F}, {0.0F, 0.09F, 0.0F});
  }
  for (const float side : {-1.0F, 1.0F}) {  // the sides of the cupboard around the basin
    parts.box({kDepth - 0.05F, 0.018F, 0.17F},
              {-0.02F, side * (0.5F * kWidth - 0.009F), kTop - 0.2F}, front);
  }
  const Eigen::Vector4f hole(-0.2F, 0.2F, -0.45F, 0.05F);  // x from, x to, y from, y to
  add_worktop(parts, {kDepth + 0.02F, kWidth + 0.02F, 0.035F}, hole, kTop, stone);
  add_basin(parts, {0.394F, 0.494F}, {0.0F, -0.2F, kTop});
  const render::Material chrome = materials::chrome();
  parts.pipe({{-0.25F, -0.2F, kTop},
              {-0.25F, -0.2F, kTop + 0.24F},
              {-0.22F, -0.2F, kTop + 0.29F},
              {-0.12F, -0.2F, kTop + 0.29F},
              {-0.08F, -0.2F, kTop + 0.25F}},
             0.012F, chrome);
  parts.bar({-0.25F, -0.17F, kTop + 0.05F}, {-0.25F, -0.11F, kTop + 0.09F}, 0.008F, chrome);
  return appliance("sink", parts, kTop);
}

FurnitureModel microwave(Random& random) {
  const render::Material shell = random.chance(0.5) ? materials::plain({215, 218, 220}, 0.4F)
                                                    : materials::metal({90, 90, 92}, random);
  const render::Material dark = materials::plain({26, 25, 24}, 0.5F);
  Assembly parts;
  const auto height = static_cast<float>(random.uniform(0.265, 0.285));
  parts.cushion({0.36F, 0.48F, height}, placed({0.0F, 0.0F, 0.01F}), 0.01F, shell);
  for (const float x : {-0.13F, 0.13F}) {
    for (const float y : {-0.18F, 0.18F}) parts.bar({x, y, 0.0F}, {x, y, 0.014F}, 0.015F, dark);
  }
  parts.box({0.006F, 0.33F, 0.23F}, {0.181F, -0.06F, 0.03F}, dark);
  parts.box({0.004F, 0.24F, 0.15F}, {0.185F, -0.07F, 0.07F}, materials::black_glass());
  add_bar_handle(parts, {0.182F, 0.095F, 0.145F}, {0.0F, 0.0F, 0.09F});
  parts.add(render::make_picture(0.075F, 0.025F, materials::glowing({90, 220, 60}, 0.8F)),
            placed({0.1815F, 0.17F, 0.235F}));
  for (int i = 0; i < 12; ++i) {
    const float y = 0.145F + 0.025F * static_cast<float>(i % 3);
    const int row = i / 3;
    const float z = 0.2F - 0.032F * static_cast<float>(row);
    parts.box({0.004F, 0.018F, 0.018F}, {0.182F, y, z}, dark);
  }
  return appliance("microwave", parts, double{height} + 0.01);
}

}  // namespace tsg::simulation::pieces
