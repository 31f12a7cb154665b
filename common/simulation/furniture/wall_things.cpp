#include <cmath>
#include <numbers>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

FurnitureModel hung(const std::string& class_name, const Assembly& parts) {
  FurnitureModel model;
  model.class_name = class_name;
  model.mesh = parts.finished();
  return model;
}

/// Bars of `bar_m` around a face of `size_m` (width, height), `depth_m` deep.
void add_frame(Assembly& parts,
               const Eigen::Vector2f& size_m,
               float bar_m,
               float depth_m,
               const render::Material& material) {
  const float x = 0.5F * depth_m;
  for (const float side : {-1.0F, 1.0F}) {
    parts.box({depth_m, bar_m, size_m.y()}, {x, side * 0.5F * (size_m.x() - bar_m), 0.0F},
              material);
  }
  const float inner = size_m.x() - 2.0F * bar_m;
  parts.box({depth_m, inner, bar_m}, {x, 0.0F, 0.0F}, material);
  parts.box({depth_m, inner, bar_m}, {x, 0.0F, size_m.y() - bar_m}, material);
}

/// A picture with a frame around it, on a thin back.
void add_framed(Assembly& parts,
                const Eigen::Vector2f& size_m,
                const render::Material& picture,
                const render::Material& frame) {
  constexpr float kBar = 0.022F;
  add_frame(parts, size_m, kBar, 0.022F, frame);
  parts.box({0.008F, size_m.x() - 2.0F * kBar, size_m.y() - 2.0F * kBar}, {0.004F, 0.0F, kBar},
            frame);
  parts.add(render::make_picture(size_m.x() - 2.0F * kBar, size_m.y() - 2.0F * kBar, picture),
            placed({0.01F, 0.0F, kBar}));
}

}  // namespace

FurnitureModel poster(Random& random) {
  const bool is_upright = random.chance(0.5);
  const auto longer = static_cast<float>(random.uniform(0.7, 0.95));
  const float shorter = 0.71F * longer;
  const Eigen::Vector2f size =
      is_upright ? Eigen::Vector2f(shorter, longer) : Eigen::Vector2f(longer, shorter);
  const render::Material picture = materials::pictured(textures::poster(random), 1.0, 0.1F);
  const render::Material frame =
      random.chance(0.5) ? materials::any_wood(random) : materials::dark_plastic();
  Assembly parts;
  add_framed(parts, size, picture, frame);
  return hung("poster", parts);
}

FurnitureModel whiteboard(Random& random) {
  const Eigen::Vector2f size(static_cast<float>(random.uniform(1.5, 1.9)), 1.05F);
  const render::Material aluminium = materials::metal({205, 206, 208}, random);
  Assembly parts;
  add_framed(parts, size, materials::pictured(textures::written_board(random), 1.0, 0.35F),
             aluminium);
  parts.box({0.07F, 0.7F, 0.012F}, {0.045F, 0.0F, 0.005F}, aluminium);
  for (int i = 0; i < 4; ++i) {
    const float y = -0.25F + 0.14F * static_cast<float>(i);
    parts.bar({0.05F, y, 0.025F}, {0.05F, y + 0.12F, 0.025F}, 0.008F,
              materials::plain(paint::any_colour(random), 0.3F));
  }
  parts.box({0.05F, 0.1F, 0.035F}, {0.05F, 0.31F, 0.017F}, materials::plain({90, 60, 40}));
  return hung("whiteboard", parts);
}

FurnitureModel clock(Random& random) {
  const auto radius = static_cast<float>(random.uniform(0.14, 0.18));
  const render::Material rim = materials::plain(materials::upholstery_colour(random), 0.4F);
  Assembly lying;  // faces up; stood up below
  lying.turned({{{radius, 0.0F}, {radius, 0.03F}, {radius - 0.006F, 0.036F}},
                {{radius - 0.006F, 0.036F}, {radius - 0.014F, 0.03F}, {radius - 0.014F, 0.018F}}},
               Vector3f::Zero(), rim, 40);
  render::Mesh face =
      render::make_disc(radius - 0.013F, 40, materials::pictured(textures::clock_face(random)));
  // uv of a disc is in metres around its middle; up of the face is -x once it stands.
  for (std::size_t i = 0; i < face.uvs.size(); ++i) {
    const Vector3f share = face.points[i] / (2.0F * radius);
    face.uvs[i] = {0.5F + share.y(), 0.5F + share.x()};
  }
  lying.add(face, placed({0.0F, 0.0F, 0.02F}));
  Assembly parts;
  parts.add(lying.finished(), tilted({0.0F, 0.0F, radius}, 0.5 * std::numbers::pi));
  return hung("clock", parts);
}

FurnitureModel notice_board(Random& random) {
  Assembly parts;
  add_framed(parts, {1.2F, 0.9F}, materials::pictured(textures::pinned_papers(random), 1.0, 0.0F),
             materials::any_wood(random));
  return hung("notice board", parts);
}

FurnitureModel curtain(Random& random) {
  constexpr float kWidth = 0.7F;
  constexpr float kHeight = 2.3F;
  constexpr int kFolds = 7;
  constexpr int kSteps = 8 * kFolds;
  const render::Material cloth = materials::pictured(
      textures::patterned(materials::upholstery_colour(random), random), 0.5, 0.0F);
  Assembly parts;
  render::Mesh sheet;
  sheet.materials.push_back(cloth);
  for (int i = 0; i <= kSteps; ++i) {
    const float share = static_cast<float>(i) / kSteps;
    const float phase = 2.0F * std::numbers::pi_v<float> * kFolds * share;
    const float slope = 0.035F * 2.0F * std::numbers::pi_v<float> * kFolds / kWidth;
    const Vector3f normal = Vector3f(1.0F, -slope * std::cos(phase), 0.0F).normalized();
    for (const float z : {0.0F, kHeight}) {
      sheet.points.emplace_back(0.06F + 0.035F * std::sin(phase), kWidth * (share - 0.5F), z);
      sheet.normals.push_back(normal);
      sheet.uvs.emplace_back(1.5F * kWidth * share, -z);
    }
  }
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const std::uint32_t a = 2 * i;
    sheet.triangles.push_back({{a, a + 2, a + 3}, 0});
    sheet.triangles.push_back({{a, a + 3, a + 1}, 0});
  }
  parts.add(sheet);
  parts.bar({0.06F, -0.45F, kHeight + 0.02F}, {0.06F, 0.45F, kHeight + 0.02F}, 0.014F,
            materials::chrome());
  for (const float y : {-0.4F, 0.4F}) {
    parts.bar({0.0F, y, kHeight + 0.02F}, {0.06F, y, kHeight + 0.02F}, 0.01F, materials::chrome());
  }
  return hung("curtain", parts);
}

FurnitureModel radiator(Random& random) {
  const int ribs = random.integer(10, 16);
  const render::Material enamel = materials::plain({226, 230, 232}, 0.4F);
  constexpr float kPitch = 0.06F;
  const float width = kPitch * static_cast<float>(ribs);
  Assembly parts;
  for (int i = 0; i < ribs; ++i) {
    const float y = kPitch * (static_cast<float>(i) + 0.5F) - 0.5F * width;
    parts.cushion({0.09F, 0.044F, 0.58F}, placed({0.085F, y, 0.0F}), 0.02F, enamel);
  }
  for (const float z : {0.05F, 0.53F}) {
    parts.bar({0.085F, -0.5F * width, z}, {0.085F, 0.5F * width, z}, 0.022F, enamel);
  }
  parts.pipe({{0.085F, 0.5F * width, 0.05F},
              {0.085F, 0.5F * width + 0.06F, 0.05F},
              {0.085F, 0.5F * width + 0.08F, 0.0F}},
             0.012F, enamel);
  parts.bar({0.085F, 0.5F * width, 0.53F}, {0.085F, 0.5F * width + 0.09F, 0.53F}, 0.022F,
            materials::plain({215, 218, 220}, 0.2F));
  return hung("radiator", parts);
}

}  // namespace tsg::simulation::pieces
