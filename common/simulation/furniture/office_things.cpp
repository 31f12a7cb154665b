#include <cmath>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"
#include "common/simulation/furniture/thing.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

}  // namespace

FurnitureModel waste_bin(Random& random) {
  const auto height = static_cast<float>(random.uniform(0.28, 0.36));
  const render::Material shell = materials::metal(materials::upholstery_colour(random), random);
  Assembly parts;
  parts.turned({{{0.001F, 0.0F}, {0.11F, 0.0F}},
                {{0.11F, 0.0F}, {0.145F, height}},
                {{0.145F, height}, {0.14F, height}},
                {{0.14F, height}, {0.108F, 0.01F}},
                {{0.108F, 0.01F}, {0.001F, 0.01F}}},
               Vector3f::Zero(), shell, 24);
  const int crumpled = random.integer(2, 5);
  for (int i = 0; i < crumpled; ++i) {
    const Vector3f at(0.05F * static_cast<float>(random.normal()),
                      0.05F * static_cast<float>(random.normal()), 0.55F * height);
    render::Mesh ball = render::make_rounded_box({0.09F, 0.09F, 0.09F}, 0.04F,
                                                 materials::plain({228, 232, 234}, 0.0F));
    const auto phase = static_cast<float>(random.uniform(0.0, 6.0));
    for (Vector3f& point : ball.points) {  // dents
      point *= 1.0F + 0.05F * std::sin(90.0F * point.y() + phase) * std::sin(80.0F * point.z());
    }
    parts.add(ball, placed(at, random.uniform(0.0, 3.0)));
  }
  return thing("waste bin", parts);
}

FurnitureModel fire_extinguisher(Random& random) {
  const render::Material red = materials::plain({30, 25, 190}, 0.6F);
  const render::Material print =
      materials::pictured(textures::label({228, 235, 238}, random), 1.0, 0.2F);
  constexpr float kRadius = 0.075F;
  Assembly parts;
  parts.turned({{{0.001F, 0.0F}, {kRadius - 0.01F, 0.0F}},
                {{kRadius - 0.01F, 0.0F},
                 {kRadius, 0.015F},
                 {kRadius, 0.38F},
                 {0.055F, 0.43F},
                 {0.02F, 0.46F},
                 {0.02F, 0.48F}}},
               Vector3f::Zero(), red, 24);
  render::Mesh label =
      render::make_turned({{kRadius + 0.001F, 0.12F}, {kRadius + 0.001F, 0.3F}}, 24, print);
  for (std::size_t i = 0; i < label.uvs.size(); ++i) {
    label.uvs[i] = {2.0F * label.uvs[i].x(), -(label.points[i].z() - 0.12F) / 0.18F};
  }
  parts.add(label);
  const render::Material black = materials::dark_plastic();
  parts.box({0.05F, 0.035F, 0.035F}, {0.0F, 0.0F, 0.475F}, black);
  parts.bar({0.0F, 0.0F, 0.505F}, {-0.11F, 0.0F, 0.54F}, 0.009F, black);
  parts.bar({0.0F, 0.0F, 0.485F}, {-0.11F, 0.0F, 0.49F}, 0.009F, black);
  parts.pipe({{0.02F, 0.0F, 0.49F},
              {0.09F, 0.01F, 0.47F},
              {0.11F, 0.02F, 0.38F},
              {0.1F, 0.02F, 0.2F},
              {0.095F, 0.02F, 0.12F}},
             0.011F, black);
  return thing("fire extinguisher", parts);
}

FurnitureModel cart(Random& random) {
  constexpr float kLength = 0.8F;
  constexpr float kWidth = 0.5F;
  constexpr float kTop = 0.82F;
  const render::Material tray = materials::metal(materials::upholstery_colour(random), random);
  const render::Material steel = materials::chrome();
  const render::Material rubber = materials::dark_plastic();
  Assembly parts;
  for (const float z : {0.16F, 0.49F, kTop - 0.02F}) {
    parts.box({kLength, kWidth, 0.02F}, {0.0F, 0.0F, z}, tray);
    if (z > 0.7F) continue;  // things stand on top: no rim there
    for (const float side : {-1.0F, 1.0F}) {
      parts.box({kLength, 0.012F, 0.05F}, {0.0F, side * 0.5F * (kWidth - 0.012F), z + 0.02F}, tray);
    }
  }
  for (const float x : {-0.36F, 0.36F}) {
    for (const float y : {-0.22F, 0.22F}) {
      parts.bar({x, y, 0.08F}, {x, y, kTop - 0.01F}, 0.014F, steel);
      parts.bar({x, y - 0.014F, 0.05F}, {x, y + 0.014F, 0.05F}, 0.05F, rubber);
    }
  }
  parts.pipe({{-0.36F, -0.22F, kTop},
              {-0.42F, -0.22F, 0.96F},
              {-0.45F, -0.2F, 1.0F},
              {-0.45F, 0.2F, 1.0F},
              {-0.42F, 0.22F, 0.96F},
              {-0.36F, 0.22F, kTop}},
             0.014F, steel);
  const render::Material card = materials::pictured(textures::cardboard(random), 0.36, 0.0F);
  parts.box({0.3F, 0.36F, 0.22F}, {0.12F, 0.0F, 0.51F}, card, 0.1);
  parts.box({0.36F, 0.34F, 0.2F}, {-0.1F, 0.02F, 0.18F}, card, -0.06);
  FurnitureModel model = thing("cart", parts);
  model.top_m = kTop;
  model.grip_height_m = 1.0;
  return model;
}

FurnitureModel printer(Random& random) {
  const render::Material light = materials::plain({214, 218, 220}, 0.2F);
  const render::Material dark = materials::dark_plastic();
  Assembly parts;
  parts.cushion({0.42F, 0.44F, 0.15F}, placed({0.0F, 0.0F, 0.0F}), 0.015F, dark);
  parts.cushion({0.42F, 0.44F, 0.16F}, placed({0.0F, 0.0F, 0.145F}), 0.02F, light);
  parts.box({0.01F, 0.32F, 0.05F}, {0.21F, 0.0F, 0.15F}, materials::plain({12, 12, 12}, 0.0F));
  parts.box({0.14F, 0.26F, 0.012F}, {0.2F, 0.0F, 0.15F},
            materials::pictured(textures::newspaper(random), 0.26, 0.0F));
  parts.box({0.004F, 0.3F, 0.03F}, {0.211F, 0.0F, 0.05F}, materials::plain({80, 80, 80}, 0.2F));
  parts.add(render::make_picture(0.13F, 0.06F, materials::lit_screen(textures::screen(random))),
            tilted({0.205F, 0.12F, 0.245F}, -0.5));
  for (int i = 0; i < 8; ++i) {
    const int row = i / 4;
    parts.box({0.012F, 0.012F, 0.004F},
              {0.17F - 0.022F * static_cast<float>(row),
               -0.02F - 0.025F * static_cast<float>(i % 4), 0.303F},
              i == 0 ? materials::plain({60, 180, 60}) : dark);
  }
  FurnitureModel model = thing("printer", parts);
  model.top_m = 0.305;
  return model;
}

FurnitureModel water_cooler(Random& random) {
  const render::Material body = materials::plain({224, 228, 230}, 0.3F);
  const render::Material dark = materials::dark_plastic();
  const render::Material water = materials::plain({205, 165, 110}, 0.8F);
  constexpr float kBody = 0.98F;
  Assembly parts;
  parts.cushion({0.31F, 0.31F, kBody}, placed({0.0F, 0.0F, 0.0F}), 0.03F, body);
  parts.box({0.012F, 0.22F, 0.24F}, {0.152F, 0.0F, 0.62F}, dark);
  parts.box({0.09F, 0.2F, 0.02F}, {0.18F, 0.0F, 0.61F}, dark);
  for (const float side : {-1.0F, 1.0F}) {
    const render::Material tap = materials::plain(
        side < 0.0F ? paint::Colour(200, 90, 30) : paint::Colour(40, 40, 200), 0.4F);
    parts.pipe(
        {{0.15F, side * 0.05F, 0.8F}, {0.2F, side * 0.05F, 0.8F}, {0.2F, side * 0.05F, 0.76F}},
        0.012F, tap);
  }
  parts.turned({{{0.05F, kBody - 0.01F},
                 {0.05F, kBody + 0.03F},
                 {0.13F, kBody + 0.08F},
                 {0.135F, kBody + 0.2F},
                 {0.128F, kBody + 0.215F},
                 {0.135F, kBody + 0.23F},
                 {0.135F, kBody + 0.36F},
                 {0.11F, kBody + 0.38F},
                 {0.001F, kBody + 0.38F}}},
               Vector3f::Zero(), water, 24);
  parts.add(render::make_picture(0.16F, 0.12F,
                                 materials::pictured(textures::label({220, 150, 80}, random))),
            placed({0.157F, 0.0F, 0.3F}));
  return thing("water cooler", parts);
}

}  // namespace tsg::simulation::pieces
