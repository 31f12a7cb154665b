#include <cmath>
#include <numbers>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"
#include "common/simulation/furniture/thing.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

/// A key with one letter of the picture of caps.
void add_key(Assembly& parts,
             const Vector3f& at,
             float width_m,
             const render::Material& caps,
             Random& random) {
  render::Mesh key = render::make_box({0.0155F, width_m, 0.006F}, caps);
  // Letters stand upright for who sits at +x.
  const int cell = random.integer(0, 15);
  const int cell_row = cell / 4;
  const Eigen::Vector2f corner(0.25F * static_cast<float>(cell % 4),
                               0.25F * static_cast<float>(cell_row));
  for (std::size_t i = 0; i < key.uvs.size(); ++i) {
    const Vector3f& point = key.points[i];
    const Eigen::Vector2f share(point.y() / width_m + 0.5F, point.x() / 0.0155F + 0.5F);
    key.uvs[i] = corner + 0.25F * share;
  }
  parts.add(key, placed(at));
}

}  // namespace

FurnitureModel keyboard(Random& random) {
  constexpr float kPitch = 0.019F;
  constexpr int kColumns = 22;
  constexpr float kWidth = kPitch * kColumns + 0.02F;
  const render::Material caps = materials::pictured(textures::key_caps(random), 1.0, 0.1F);
  const render::Material body =
      materials::plain(paint::scaled({60, 58, 56}, random.uniform(0.4, 1.6)), 0.2F);
  Assembly parts;
  parts.cushion({0.15F, kWidth, 0.016F}, tilted({0.0F, 0.0F, 0.003F}, 0.03), 0.005F, body);
  for (int row = 0; row < 6; ++row) {
    const float x = 0.055F - 0.0205F * static_cast<float>(row) - (row == 5 ? 0.006F : 0.0F);
    const float z = 0.0178F - 0.03F * x;
    for (int column = 0; column < kColumns; ++column) {
      if (column == 15 || column == 18) continue;  // gaps between the blocks
      const float y = kPitch * (static_cast<float>(column) - 0.5F * (kColumns - 1));
      const bool is_space = row == 0 && column >= 4 && column <= 9;
      if (is_space && column != 4) continue;
      const float width = is_space ? 6.0F * kPitch - 0.003F : kPitch - 0.003F;
      add_key(parts, {x, is_space ? y + 2.5F * kPitch : y, z}, width, caps, random);
    }
  }
  return thing("keyboard", parts);
}

FurnitureModel mouse(Random& random) {
  const paint::Colour colour =
      random.chance(0.6) ? paint::Colour(42, 40, 39) : paint::Colour(215, 218, 220);
  const render::Material shell =
      materials::plain(paint::scaled(colour, random.uniform(0.8, 1.1)), 0.3F);
  render::Mesh body = render::make_rounded_box({0.11F, 0.062F, 0.036F}, 0.018F, shell, 6);
  for (Vector3f& point : body.points) {
    const float along = point.x() / 0.055F;
    point.z() *= 1.0F - 0.25F * (along - 0.2F) * (along - 0.2F);
    point.y() *= 1.0F - 0.12F * along * along;
  }
  Assembly parts;
  parts.add(body);
  parts.bar({-0.03F, -0.004F, 0.0275F}, {-0.03F, 0.004F, 0.0275F}, 0.008F,
            materials::plain({120, 120, 120}));
  parts.pipe({{-0.05F, 0.0F, 0.008F},
              {-0.09F, 0.005F, 0.003F},
              {-0.15F, 0.03F, 0.003F},
              {-0.2F, 0.02F, 0.003F}},
             0.002F, materials::dark_plastic());
  return thing("mouse", parts);
}

FurnitureModel cup(Random& random) {
  const auto radius = static_cast<float>(random.uniform(0.036, 0.043));
  const auto height = static_cast<float>(random.uniform(0.085, 0.105));
  const paint::Colour glaze =
      random.chance(0.4) ? paint::Colour(235, 238, 240) : paint::any_colour(random);
  const render::Material inside =
      materials::plain(paint::between(glaze, {240, 242, 242}, 0.6), 0.5F);
  const render::Material print = materials::pictured(textures::label(glaze, random), 1.0, 0.4F);
  Assembly parts;
  // The print goes around once; its v runs over the height.
  render::Mesh wall =
      render::make_turned({{radius * 0.95F, 0.0F}, {radius, 0.01F}, {radius, height}}, 24, print);
  for (std::size_t i = 0; i < wall.uvs.size(); ++i) wall.uvs[i].y() = -wall.points[i].z() / height;
  parts.add(wall);
  parts.turned({{{radius, height}, {radius - 0.004F, height}},
                {{radius - 0.004F, height}, {radius - 0.005F, 0.008F}},
                {{radius - 0.005F, 0.008F}, {0.001F, 0.008F}}},
               Vector3f::Zero(), inside, 24);
  parts.add(render::make_disc(radius - 0.0045F, 20, materials::plain({18, 30, 48}, 0.6F)),
            placed({0.0F, 0.0F, 0.72F * height}));
  std::vector<Vector3f> handle;
  for (int i = 0; i <= 8; ++i) {
    const double angle = std::numbers::pi * (0.5 - i / 8.0);
    handle.emplace_back(0.0F, radius - 0.002F + 0.03F * static_cast<float>(std::cos(angle)),
                        0.5F * height + 0.028F * static_cast<float>(std::sin(angle)));
  }
  parts.pipe(handle, 0.005F, materials::plain(glaze, 0.5F));
  return thing("cup", parts);
}

FurnitureModel bottle(Random& random) {
  const auto radius = static_cast<float>(random.uniform(0.032, 0.042));
  const auto height = static_cast<float>(random.uniform(0.22, 0.3));
  const paint::Colour colour =
      paint::hsv(random.uniform(60.0, 240.0), random.uniform(0.3, 0.8), random.uniform(0.3, 0.75));
  const float shoulder = 0.68F * height;
  Assembly parts;
  parts.turned({{{0.001F, 0.0F}, {radius - 0.004F, 0.0F}},
                {{radius - 0.004F, 0.0F},
                 {radius, 0.006F},
                 {radius, shoulder},
                 {0.75F * radius, shoulder + 0.03F},
                 {0.013F, height - 0.03F},
                 {0.013F, height - 0.018F}}},
               Vector3f::Zero(), materials::plain(colour, 0.7F), 20);
  parts.turned({{{0.016F, height - 0.02F}, {0.016F, height}}, {{0.016F, height}, {0.001F, height}}},
               Vector3f::Zero(), materials::plain(paint::any_colour(random), 0.3F), 16);
  const render::Material paper =
      materials::pictured(textures::label({236, 240, 242}, random), 1.0, 0.1F);
  render::Mesh label = render::make_turned(
      {{radius + 0.0008F, 0.25F * height}, {radius + 0.0008F, 0.55F * height}}, 20, paper);
  for (std::size_t i = 0; i < label.uvs.size(); ++i) {
    label.uvs[i].y() = -(label.points[i].z() / height - 0.25F) / 0.3F;
  }
  parts.add(label);
  return thing("bottle", parts);
}

FurnitureModel newspaper(Random& random) {
  const render::Material page = materials::pictured(textures::newspaper(random), 1.0, 0.0F);
  Assembly parts;
  parts.box({0.36F, 0.27F, 0.006F}, Vector3f::Zero(), materials::plain({205, 214, 218}, 0.0F));
  render::Mesh front = render::make_picture(0.27F, 0.36F, page);
  // Turned about y, the picture lies down, its top away from who sits at +x.
  parts.add(front, tilted({0.18F, 0.0F, 0.0068F}, -0.5 * std::numbers::pi));
  return thing("newspaper", parts);
}

FurnitureModel pen_pot(Random& random) {
  Assembly parts;
  const render::Material pot = materials::metal(materials::upholstery_colour(random), random);
  parts.turned({{{0.001F, 0.0F}, {0.038F, 0.0F}},
                {{0.038F, 0.0F}, {0.04F, 0.1F}},
                {{0.04F, 0.1F}, {0.037F, 0.1F}},
                {{0.037F, 0.1F}, {0.035F, 0.005F}},
                {{0.035F, 0.005F}, {0.001F, 0.005F}}},
               Vector3f::Zero(), pot, 18);
  const int count = random.integer(5, 9);
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vector3f lean(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                        0.0F);
    const auto length = static_cast<float>(random.uniform(0.13, 0.17));
    parts.bar(-0.02F * lean + Vector3f(0.0F, 0.0F, 0.01F),
              0.04F * lean + Vector3f(0.0F, 0.0F, length), 0.004F,
              materials::plain(paint::any_colour(random), 0.3F));
  }
  return thing("pen pot", parts);
}

}  // namespace tsg::simulation::pieces
