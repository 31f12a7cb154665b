#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

struct Leaf {
  float length_m = 0.2F;
  float width_m = 0.06F;
  float rise_rad = 0.8F;   ///< how steeply it leaves the stalk
  float droop_rad = 1.2F;  ///< how far its tip bends down from there
};

constexpr std::uint32_t kLeafSteps = 7;  // rows of faces along a leaf

/// Points, normals and uvs of one side (1: upper, -1: lower) of a leaf that starts at the origin
/// and bends along +x: rows of three, across the middle rib.
void add_leaf_points(render::Mesh& mesh, const Leaf& leaf, float side) {
  Vector3f spine = Vector3f::Zero();
  for (std::uint32_t i = 0; i <= kLeafSteps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(kLeafSteps);
    const float angle = leaf.rise_rad - leaf.droop_rad * share;
    const Vector3f along(std::cos(angle), 0.0F, std::sin(angle));
    const Vector3f up(-along.z(), 0.0F, along.x());
    // At the tip the sine may come out below zero by rounding.
    const float bulge = std::max(0.0F, std::sin(std::numbers::pi_v<float> * std::sqrt(share)));
    const float half = 0.5F * leaf.width_m * std::pow(bulge, 0.8F);
    for (const float across : {-1.0F, 0.0F, 1.0F}) {
      const float fold = 0.35F * half * std::abs(across);  // both halves rise from the rib
      mesh.points.emplace_back(spine + across * half * Vector3f::UnitY() + fold * up);
      mesh.normals.emplace_back(
          (side * up - side * 0.3F * across * Vector3f::UnitY()).normalized());
      mesh.uvs.emplace_back(0.5F + 0.45F * across, 1.0F - share);
    }
    spine += along * leaf.length_m / static_cast<float>(kLeafSteps);
  }
}

void add_leaf_side(render::Mesh& mesh, const Leaf& leaf, float side) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  add_leaf_points(mesh, leaf, side);
  for (std::uint32_t face = 0; face < 2 * kLeafSteps; ++face) {
    const std::uint32_t a = first + 3 * (face / 2) + face % 2;
    std::array<std::uint32_t, 4> quad = {a, a + 3, a + 4, a + 1};
    if (side < 0.0F) std::swap(quad[1], quad[3]);
    mesh.triangles.push_back({{quad[0], quad[1], quad[2]}, 0});
    mesh.triangles.push_back({{quad[0], quad[2], quad[3]}, 0});
  }
}

render::Mesh make_leaf(const Leaf& leaf, const render::Material& material) {
  render::Mesh mesh;
  mesh.materials.push_back(material);
  add_leaf_side(mesh, leaf, 1.0F);
  add_leaf_side(mesh, leaf, -1.0F);
  return mesh;
}

std::vector<render::Material> leaf_materials(Random& random) {
  std::vector<render::Material> greens;
  const double hue = random.uniform(85.0, 130.0);
  for (int i = 0; i < 3; ++i) {
    const paint::Colour green =
        paint::hsv(hue + 8.0 * i, random.uniform(0.5, 0.7), random.uniform(0.32, 0.62));
    greens.push_back(materials::pictured(textures::leaf(green, random), 1.0, 0.2F));
  }
  return greens;
}

/// A pot with soil up to just under its rim; returns the height of the soil.
float add_pot(Assembly& parts, float radius_m, float height_m, Random& random) {
  constexpr std::array<std::array<double, 3>, 4> kGlazes = {
      {{60, 95, 165}, {225, 230, 232}, {70, 66, 64}, {150, 120, 70}}};
  const auto& glaze = kGlazes.at(static_cast<std::size_t>(random.integer(0, 3)));
  const render::Material clay =
      materials::pictured(textures::concrete({glaze[0], glaze[1], glaze[2]}, random), 1.5, 0.15F);
  const float rim = 0.12F * height_m;
  parts.turned(
      {{{0.001F, 0.0F}, {0.7F * radius_m, 0.0F}},
       {{0.7F * radius_m, 0.0F}, {0.95F * radius_m, height_m - rim}},
       {{0.95F * radius_m, height_m - rim}, {radius_m, height_m - rim}, {radius_m, height_m}},
       {{radius_m, height_m}, {0.88F * radius_m, height_m}},
       {{0.88F * radius_m, height_m}, {0.86F * radius_m, height_m - rim}}},
      Vector3f::Zero(), clay, 24);
  const float soil = height_m - 0.6F * rim;
  parts.add(render::make_disc(0.875F * radius_m, 20,
                              materials::pictured(textures::soil(random), 0.3, 0.0F)),
            placed({0.0F, 0.0F, soil}));
  return soil;
}

void add_leaf(Assembly& parts,
              const Vector3f& at,
              const Leaf& leaf,
              const std::vector<render::Material>& greens,
              Random& random) {
  const auto index =
      static_cast<std::size_t>(random.integer(0, static_cast<int>(greens.size()) - 1));
  parts.add(make_leaf(leaf, greens[index]),
            placed(at, random.uniform(0.0, 2.0 * std::numbers::pi)));
}

FurnitureModel plant_of(const Assembly& parts) {
  FurnitureModel model;
  model.class_name = "potted plant";
  model.mesh = parts.finished();
  return model;
}

}  // namespace

FurnitureModel vase(Random& random) {
  const auto height = static_cast<float>(random.uniform(0.2, 0.32));
  const auto belly = static_cast<float>(random.uniform(0.06, 0.09));
  const render::Material glaze =
      materials::pictured(textures::patterned(paint::any_colour(random), random), 1.0, 0.5F);
  std::vector<render::OutlinePoint> outline;
  for (int i = 0; i <= 12; ++i) {
    const float share = static_cast<float>(i) / 12.0F;
    const float swell = std::sin(2.6F * share + 0.35F);
    outline.push_back({0.35F * belly + 0.65F * belly * swell * swell, share * height});
  }
  const float mouth = outline.back().radius_m;
  Assembly parts;
  parts.turned(
      {{{0.001F, 0.0F}, outline.front()},
       outline,
       {{mouth, height}, {mouth - 0.005F, height}},
       {{mouth - 0.005F, height}, {mouth - 0.008F, 0.7F * height}, {0.001F, 0.6F * height}}},
      Vector3f::Zero(), glaze, 24);
  const std::vector<render::Material> greens = leaf_materials(random);
  const int stems = random.integer(0, 7);
  for (int i = 0; i < stems; ++i) {
    const Vector3f tip(0.08F * static_cast<float>(random.normal()),
                       0.08F * static_cast<float>(random.normal()),
                       height + static_cast<float>(random.uniform(0.1, 0.22)));
    parts.bar({0.0F, 0.0F, 0.7F * height}, tip, 0.003F, greens.front());
    const paint::Colour petal = paint::any_colour(random);
    for (int leaf = 0; leaf < 7; ++leaf) {
      add_leaf(parts, tip, {0.05F, 0.03F, 0.7F, 0.9F}, {materials::plain(petal, 0.0F)}, random);
    }
  }
  FurnitureModel model;
  model.class_name = "vase";
  model.mesh = parts.finished();
  return model;
}

FurnitureModel potted_plant(Random& random) {
  Assembly parts;
  const auto radius = static_cast<float>(random.uniform(0.08, 0.11));
  const float soil = add_pot(parts, radius, 1.6F * radius, random);
  const std::vector<render::Material> greens = leaf_materials(random);
  const int leaves = random.integer(22, 34);
  const bool is_slender = random.chance(0.5);
  for (int i = 0; i < leaves; ++i) {
    Leaf leaf;
    leaf.length_m = static_cast<float>(random.uniform(0.16, 0.32));
    leaf.width_m = is_slender ? 0.025F : static_cast<float>(random.uniform(0.06, 0.09));
    leaf.rise_rad = static_cast<float>(random.uniform(0.6, 1.5));
    leaf.droop_rad = static_cast<float>(random.uniform(0.6, 1.9));
    const Vector3f at(0.25F * radius * static_cast<float>(random.normal()),
                      0.25F * radius * static_cast<float>(random.normal()), soil - 0.01F);
    add_leaf(parts, at, leaf, greens, random);
  }
  return plant_of(parts);
}

FurnitureModel big_plant(Random& random) {
  Assembly parts;
  const auto height = static_cast<float>(random.uniform(1.3, 1.8));
  const float soil = add_pot(parts, 0.19F, 0.34F, random);
  const std::vector<render::Material> greens = leaf_materials(random);
  const render::Material bark = materials::pictured(textures::bark(random), 0.5, 0.0F);
  const int trunks = random.integer(2, 4);
  for (int i = 0; i < trunks; ++i) {
    const double around = 2.0 * std::numbers::pi * (i + random.uniform(0.0, 0.6)) / trunks;
    const Vector3f out(static_cast<float>(std::cos(around)), static_cast<float>(std::sin(around)),
                       0.0F);
    const float top = height * (1.0F - 0.2F * static_cast<float>(i)) - 0.15F;
    const Vector3f foot = 0.05F * out + Vector3f(0.0F, 0.0F, soil - 0.02F);
    const Vector3f tip = 0.16F * out + Vector3f(0.0F, 0.0F, top);
    parts.pipe({foot, 0.5F * (foot + tip) + 0.03F * out, tip}, 0.016F, bark);
    for (int k = 0; k < 34; ++k) {
      const auto share = static_cast<float>(random.uniform(0.3, 1.0));
      Leaf leaf;
      leaf.length_m = static_cast<float>(random.uniform(0.2, 0.36));
      leaf.width_m = static_cast<float>(random.uniform(0.06, 0.11));
      leaf.rise_rad = static_cast<float>(random.uniform(0.2, 1.2));
      leaf.droop_rad = static_cast<float>(random.uniform(0.8, 1.8));
      add_leaf(parts, foot + share * (tip - foot), leaf, greens, random);
    }
  }
  return plant_of(parts);
}

}  // namespace tsg::simulation::pieces
