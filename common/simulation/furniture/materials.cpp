#include "common/simulation/furniture/materials.hpp"

#include <cmath>
#include <memory>

namespace tsg::simulation::materials {
namespace {

/// Linear light of an sRGB code (IEC 61966-2-1).
float linear(double code) {
  const double value = code / 255.0;
  const double light = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  return static_cast<float>(light);
}

}  // namespace

Material plain(const Colour& colour, float gloss) {
  Material material;
  material.colour_bgr = {linear(colour[0]), linear(colour[1]), linear(colour[2])};
  material.gloss = gloss;
  return material;
}

Material pictured(const cv::Mat& picture, double size_m, float gloss) {
  Material material;
  material.texture = std::make_shared<const render::Texture>(picture);
  material.texture_repeats = static_cast<float>(1.0 / size_m);
  material.gloss = gloss;
  return material;
}

Material wood(textures::Wood kind, Random& random) {
  return pictured(textures::wood(kind, random), 1.0, 0.15F);
}

Material any_wood(Random& random) { return materials::wood(textures::any_wood(random), random); }

Material fabric(const Colour& colour, Random& random) {
  if (random.chance(0.3)) return pictured(textures::patterned(colour, random), 0.5, 0.0F);
  return pictured(textures::weave(colour, random), 0.3, 0.0F);
}

Material leather(const Colour& colour, Random& random) {
  return pictured(textures::leather(colour, random), 0.5, 0.1F);
}

Material metal(const Colour& colour, Random& random) {
  return pictured(textures::brushed_metal(colour, random), 0.5, 0.4F);
}

Material chrome() { return plain({190, 188, 186}, 0.8F); }

Material dark_plastic() { return plain({42, 40, 39}, 0.2F); }

Material lit_screen(const cv::Mat& picture) {
  Material material = pictured(picture, 1.0, 0.1F);
  material.emission = 0.75F;
  return material;
}

Material black_glass() {
  Material material = plain({16, 15, 14}, 0.9F);
  material.returns_depth = false;
  return material;
}

Material glowing(const Colour& colour, float emission) {
  Material material = plain(colour, 0.0F);
  material.emission = emission;
  return material;
}

Colour upholstery_colour(Random& random) {
  if (random.chance(0.4)) return paint::scaled({235, 232, 230}, random.uniform(0.15, 0.5));
  return paint::scaled(paint::any_colour(random), 0.8);
}

}  // namespace tsg::simulation::materials
