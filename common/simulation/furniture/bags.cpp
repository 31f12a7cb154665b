#include <cmath>
#include <numbers>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"
#include "common/simulation/furniture/thing.hpp"

/// Things of cloth and of travel.
namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

}  // namespace

FurnitureModel backpack(Random& random) {
  const paint::Colour colour = paint::any_colour(random);
  const render::Material cloth = materials::pictured(textures::weave(colour, random), 0.3, 0.05F);
  const render::Material trim = materials::plain(paint::scaled(colour, 0.45), 0.1F);
  render::Mesh body = render::make_rounded_box({0.19F, 0.32F, 0.46F}, 0.08F, cloth, 6);
  for (Vector3f& point : body.points) {  // it slumps: wider below
    const float share = point.z() / 0.46F;
    point.y() *= 1.08F - 0.22F * share * share;
    point.x() = point.x() * (1.1F - 0.3F * share) - 0.02F * share;
  }
  Assembly parts;
  parts.add(body);
  parts.cushion({0.08F, 0.24F, 0.2F}, tilted({0.1F, 0.0F, 0.04F}, -0.08), 0.035F, cloth);
  parts.pipe({{0.128F, -0.1F, 0.2F}, {0.138F, 0.0F, 0.21F}, {0.128F, 0.1F, 0.2F}}, 0.004F, trim);
  parts.pipe({{0.02F, -0.12F, 0.41F}, {0.085F, 0.0F, 0.38F}, {0.02F, 0.12F, 0.41F}}, 0.004F, trim);
  parts.pipe({{-0.03F, -0.04F, 0.44F}, {-0.04F, 0.0F, 0.5F}, {-0.03F, 0.04F, 0.44F}}, 0.007F, trim);
  for (const float side : {-1.0F, 1.0F}) {
    parts.pipe({{-0.07F, side * 0.07F, 0.42F},
                {-0.13F, side * 0.1F, 0.36F},
                {-0.15F, side * 0.12F, 0.2F},
                {-0.09F, side * 0.13F, 0.06F}},
               0.014F, trim);
  }
  return thing("backpack", parts);
}

FurnitureModel suitcase(Random& random) {
  const auto height = static_cast<float>(random.uniform(0.48, 0.66));
  const float width = 0.66F * height;
  const render::Material shell = materials::metal(paint::any_colour(random), random);
  const render::Material trim = materials::dark_plastic();
  Assembly parts;
  parts.cushion({0.23F, width, height}, placed({0.0F, 0.0F, 0.05F}), 0.04F, shell);
  for (int i = 0; i < 5; ++i) {
    const float y = 0.16F * width * static_cast<float>(i - 2);
    for (const float side : {-1.0F, 1.0F}) {
      parts.cushion({0.012F, 0.02F, height - 0.12F}, placed({side * 0.114F, y, 0.11F}), 0.006F,
                    shell);
    }
  }
  parts.cushion({0.012F, width + 0.006F, height + 0.006F}, placed({0.0F, 0.0F, 0.047F}), 0.005F,
                trim);
  for (const float x : {-0.08F, 0.08F}) {
    for (const float side : {-1.0F, 1.0F}) {
      const float y = side * (0.5F * width - 0.05F);
      parts.bar({x, y - 0.012F, 0.026F}, {x, y + 0.012F, 0.026F}, 0.026F, trim);
      parts.box({0.02F, 0.02F, 0.03F}, {x, y, 0.03F}, trim);
    }
  }
  const float top = height + 0.05F;
  parts.pipe({{-0.05F, -0.09F, top - 0.02F},
              {-0.05F, -0.09F, top + 0.38F},
              {-0.05F, 0.09F, top + 0.38F},
              {-0.05F, 0.09F, top - 0.02F}},
             0.01F, materials::chrome());
  FurnitureModel model = thing("suitcase", parts);
  model.grip_height_m = top + 0.38;
  return model;
}

FurnitureModel rug(Random& random) {
  const Eigen::Vector2f size(static_cast<float>(random.uniform(1.3, 1.6)),
                             static_cast<float>(random.uniform(1.9, 2.4)));
  const render::Material pile = materials::pictured(textures::rug(random), 1.0, 0.0F);
  const render::Material edge = materials::plain({150, 175, 190}, 0.0F);
  Assembly parts;
  parts.box({size.x(), size.y(), 0.008F}, Vector3f::Zero(), edge);
  parts.add(render::make_picture(size.y(), size.x(), pile),
            tilted({0.5F * size.x(), 0.0F, 0.0095F}, -0.5 * std::numbers::pi));
  for (const float side : {-1.0F, 1.0F}) {  // fringes
    const auto fringes = static_cast<int>((size.x() - 0.02F) / 0.03F);
    for (int i = 0; i <= fringes; ++i) {
      const float x = -0.5F * size.x() + 0.01F + 0.03F * static_cast<float>(i);
      const float y = side * (0.5F * size.y() + 0.03F);
      parts.box({0.012F, 0.06F, 0.005F}, {x, y, 0.0F}, edge, 0.1 * random.normal());
    }
  }
  return thing("rug", parts);
}

FurnitureModel coat_rack(Random& random) {
  constexpr float kHeight = 1.78F;
  const render::Material wood = materials::any_wood(random);
  Assembly parts;
  parts.turned({{{0.001F, 0.0F}, {0.2F, 0.0F}},
                {{0.2F, 0.0F}, {0.2F, 0.02F}, {0.05F, 0.05F}, {0.024F, 0.1F}, {0.022F, kHeight}},
                {{0.022F, kHeight}, {0.03F, kHeight + 0.02F}, {0.001F, kHeight + 0.05F}}},
               Vector3f::Zero(), wood, 20);
  for (int i = 0; i < 6; ++i) {
    const double yaw = 2.0 * std::numbers::pi * i / 6.0;
    const Vector3f out(static_cast<float>(std::cos(yaw)), static_cast<float>(std::sin(yaw)), 0.0F);
    const float z = kHeight - 0.08F - 0.06F * static_cast<float>(i % 2);
    const Vector3f up = Vector3f::UnitZ();
    parts.pipe({z * up, 0.1F * out + z * up, 0.15F * out + (z + 0.05F) * up}, 0.01F, wood);
    if (!random.chance(0.5)) continue;
    // A coat: a cone of folds that hangs from the hook.
    const render::Material cloth = materials::fabric(materials::upholstery_colour(random), random);
    std::vector<render::TubeRing> rings;
    const auto length = static_cast<float>(random.uniform(0.7, 1.0));
    for (int k = 0; k <= 6; ++k) {
      const float share = static_cast<float>(k) / 6.0F;
      const float half = 0.05F + 0.17F * std::sqrt(share);
      const Vector3f across(-out.y(), out.x(), 0.0F);
      rings.push_back({(0.14F + 0.02F * share) * out + (z + 0.03F - length * share) * up,
                       0.35F * half * (k % 2 == 0 ? 1.0F : 1.25F) * out, -half * across});
    }
    parts.add(render::make_tube(rings, 14, cloth));
  }
  return thing("coat rack", parts);
}

}  // namespace tsg::simulation::pieces
