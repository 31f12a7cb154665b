#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

FurnitureModel storage(const std::string& class_name, const Assembly& parts, double top_m) {
  FurnitureModel model;
  model.class_name = class_name;
  model.mesh = parts.finished();
  model.top_m = top_m;
  return model;
}

/// A front of a door or drawer, standing out from the body at x, with a small shadow gap around.
void add_front(Assembly& parts,
               const Eigen::Vector2f& size_m,
               const Vector3f& at,
               const render::Material& material) {
  parts.box({0.018F, size_m.x() - 0.008F, size_m.y() - 0.008F}, at + Vector3f(0.009F, 0.0F, 0.004F),
            material);
}

/// A bow handle whose middle is at `at`, along `half_m`.
void add_bow_handle(Assembly& parts, const Vector3f& at, const Vector3f& half_m) {
  const Vector3f out(0.03F, 0.0F, 0.0F);
  parts.pipe({at - half_m, at - 0.9F * half_m + out, at + 0.9F * half_m + out, at + half_m}, 0.006F,
             materials::chrome());
}

/// A label in its holder on a front.
void add_label(Assembly& parts, const Vector3f& at, Random& random) {
  const render::Material print = materials::pictured(textures::label({238, 240, 240}, random));
  parts.box({0.003F, 0.085F, 0.045F}, at, materials::chrome());
  parts.add(render::make_picture(0.075F, 0.035F, print),
            placed(at + Vector3f(0.003F, 0.0F, 0.005F)));
}

}  // namespace

FurnitureModel wall_shelf(Random& random) {
  const auto width = static_cast<float>(random.uniform(0.7, 1.0));
  const render::Material wood = materials::any_wood(random);
  const render::Material steel = materials::dark_plastic();
  constexpr float kThickness = 0.026F;
  constexpr float kBelow = 0.16F;  // how far the brackets reach down
  Assembly parts;
  parts.box({0.24F, width, kThickness}, {0.122F, 0.0F, kBelow}, wood);
  for (const float side : {-1.0F, 1.0F}) {
    const float y = side * 0.36F * width;
    parts.box({0.008F, 0.03F, kBelow}, {0.004F, y, 0.0F}, steel);
    parts.bar({0.012F, y, 0.02F}, {0.2F, y, kBelow - 0.006F}, 0.008F, steel);
  }
  return storage("shelf", parts, kBelow + kThickness);
}

FurnitureModel cabinet(Random& random) {
  const auto height = static_cast<float>(random.uniform(0.95, 1.35));
  const auto width = static_cast<float>(random.uniform(0.8, 1.0));
  constexpr float kDepth = 0.42F;
  const bool is_steel = random.chance(0.4);
  const render::Material body =
      is_steel ? materials::metal({170, 172, 172}, random) : materials::any_wood(random);
  const render::Material front =
      is_steel || random.chance(0.5)
          ? body
          : materials::plain(paint::between(paint::any_colour(random), {225, 228, 230}, 0.5), 0.2F);
  Assembly parts;
  parts.box({kDepth - 0.05F, width - 0.04F, 0.06F}, {-0.01F, 0.0F, 0.0F},
            materials::dark_plastic());
  parts.box({kDepth - 0.02F, width, height - 0.08F}, {-0.01F, 0.0F, 0.06F}, body);
  parts.box({kDepth, width + 0.012F, 0.02F}, {0.0F, 0.0F, height - 0.02F}, body);
  const float x = 0.5F * kDepth - 0.02F;
  for (const float side : {-1.0F, 1.0F}) {
    const Vector3f at(x, side * 0.25F * width, 0.065F);
    add_front(parts, {0.5F * width, height - 0.09F}, at, front);
    add_bow_handle(parts, {x + 0.018F, side * 0.05F, 0.58F * height}, {0.0F, 0.0F, 0.07F});
    add_label(parts, {x + 0.018F, side * 0.25F * width, 0.8F * height}, random);
  }
  return storage("cabinet", parts, height);
}

FurnitureModel drawer_unit(Random& random) {
  constexpr float kDepth = 0.55F;
  constexpr float kWidth = 0.42F;
  constexpr float kHeight = 0.58F;
  const int drawers = random.integer(3, 4);
  const render::Material body =
      materials::metal(paint::scaled({210, 212, 213}, random.uniform(0.35, 1.05)), random);
  const render::Material front =
      random.chance(0.5) ? body : materials::plain(materials::upholstery_colour(random), 0.2F);
  const render::Material rubber = materials::dark_plastic();
  Assembly parts;
  for (const float x : {-0.22F, 0.22F}) {
    for (const float y : {-0.16F, 0.16F}) {
      parts.bar({x, y - 0.01F, 0.025F}, {x, y + 0.01F, 0.025F}, 0.025F, rubber);
    }
  }
  parts.box({kDepth - 0.02F, kWidth, kHeight - 0.05F}, {-0.01F, 0.0F, 0.05F}, body);
  const float x = 0.5F * kDepth - 0.02F;
  const float pitch = (kHeight - 0.06F) / static_cast<float>(drawers);
  for (int i = 0; i < drawers; ++i) {
    const float z = 0.055F + pitch * static_cast<float>(i);
    add_front(parts, {kWidth, pitch}, {x, 0.0F, z}, front);
    add_bow_handle(parts, {x + 0.018F, 0.0F, z + 0.7F * pitch}, {0.0F, 0.07F, 0.0F});
  }
  add_label(parts, {x + 0.018F, 0.1F, kHeight - 0.4F * pitch}, random);
  return storage("drawer unit", parts, kHeight);
}

FurnitureModel cardboard_box(Random& random) {
  const Vector3f size(static_cast<float>(random.uniform(0.28, 0.42)),
                      static_cast<float>(random.uniform(0.36, 0.5)),
                      static_cast<float>(random.uniform(0.24, 0.36)));
  const render::Material card = materials::pictured(textures::cardboard(random), size.y(), 0.0F);
  const render::Material plain = materials::plain({96, 140, 178}, 0.0F);
  Assembly parts;
  parts.box(size, Vector3f::Zero(), card);
  const bool is_open = random.chance(0.4);
  if (is_open) {  // the flaps stand out to the sides
    for (const float side : {-1.0F, 1.0F}) {
      parts.add(render::make_box({0.16F, size.y() - 0.01F, 0.004F}, plain),
                tilted({side * (0.5F * size.x() + 0.06F), 0.0F, size.z() - 0.06F}, side * 0.7));
    }
    parts.box({size.x() - 0.012F, size.y() - 0.012F, 0.002F}, {0.0F, 0.0F, size.z()},
              materials::plain({40, 62, 84}, 0.0F));
  } else {
    parts.box({size.x() + 0.002F, 0.05F, 0.001F}, {0.0F, 0.0F, size.z()},
              materials::plain({118, 170, 205}, 0.4F));
    parts.box({0.14F, 0.1F, 0.001F}, {0.05F, 0.25F * size.y(), size.z()},
              materials::pictured(textures::newspaper(random), 0.14, 0.0F));
  }
  FurnitureModel model = storage("box", parts, size.z());
  model.grip_height_m = 0.5 * size.z();
  return model;
}

}  // namespace tsg::simulation::pieces
