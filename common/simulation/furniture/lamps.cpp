#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

const paint::Colour kWarmWhite(190, 225, 250);

FurnitureModel lamp_of(const Assembly& parts) {
  FurnitureModel model;
  model.class_name = "lamp";
  model.mesh = parts.finished();
  return model;
}

}  // namespace

FurnitureModel floor_lamp(Random& random) {
  const auto height = static_cast<float>(random.uniform(1.5, 1.7));
  const render::Material steel =
      random.chance(0.5) ? materials::chrome() : materials::dark_plastic();
  render::Material shade = materials::pictured(textures::weave(kWarmWhite, random), 0.6, 0.0F);
  shade.emission = 0.55F;
  Assembly parts;
  parts.turned({{{0.001F, 0.0F}, {0.14F, 0.0F}},
                {{0.14F, 0.0F}, {0.14F, 0.018F}, {0.02F, 0.03F}, {0.012F, 0.06F}},
                {{0.012F, 0.06F}, {0.012F, height - 0.2F}}},
               Vector3f::Zero(), steel, 24);
  parts.turned(
      {{{0.2F, height - 0.3F}, {0.13F, height}}, {{0.127F, height}, {0.197F, height - 0.3F}}},
      Vector3f::Zero(), shade, 28);
  parts.turned({{{0.001F, height - 0.24F},
                 {0.03F, height - 0.22F},
                 {0.035F, height - 0.17F},
                 {0.015F, height - 0.12F}}},
               Vector3f::Zero(), materials::glowing({235, 250, 255}, 1.6F), 14);
  return lamp_of(parts);
}

FurnitureModel desk_lamp(Random& random) {
  const render::Material paint = materials::plain(materials::upholstery_colour(random), 0.5F);
  const Vector3f elbow(-0.12F, 0.0F, 0.3F);
  const Vector3f head(0.1F, 0.0F, 0.43F);
  Assembly parts;
  parts.turned({{{0.001F, 0.0F}, {0.085F, 0.0F}},
                {{0.085F, 0.0F}, {0.085F, 0.015F}, {0.02F, 0.028F}, {0.001F, 0.03F}}},
               Vector3f::Zero(), paint, 24);
  parts.bar({0.0F, 0.0F, 0.02F}, elbow, 0.008F, paint);
  parts.bar(elbow, head, 0.008F, paint);
  for (const Vector3f& joint : {elbow, head}) {
    parts.bar(joint - Vector3f(0.0F, 0.018F, 0.0F), joint + Vector3f(0.0F, 0.018F, 0.0F), 0.014F,
              materials::chrome());
  }
  const SE3 T_lamp_shade = tilted(head + Vector3f(0.06F, 0.0F, -0.1F), -0.5);
  parts.add(render::make_turned({{0.08F, 0.0F}, {0.07F, 0.05F}, {0.03F, 0.1F}, {0.001F, 0.115F}},
                                24, paint),
            T_lamp_shade);
  parts.add(render::make_turned({{0.028F, 0.097F}, {0.068F, 0.05F}, {0.078F, 0.0F}}, 24,
                                materials::plain({235, 240, 240}, 0.2F)),
            T_lamp_shade);
  parts.add(render::make_turned({{0.001F, 0.015F}, {0.028F, 0.03F}, {0.02F, 0.09F}}, 14,
                                materials::glowing({225, 245, 255}, 1.8F)),
            T_lamp_shade);
  return lamp_of(parts);
}

}  // namespace tsg::simulation::pieces
