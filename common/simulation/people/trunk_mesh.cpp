#include <algorithm>
#include <cmath>

#include "common/simulation/people/body_mesh.hpp"
#include "common/simulation/people/body_textures.hpp"
#include "common/simulation/people/easing.hpp"
#include "common/simulation/people/loft.hpp"

namespace tsg::simulation {
namespace {

/// A level cross-section of a body of 1.75 m.
struct Level {
  float z;
  float x;
  float half_width;
  float front;
  float back;
  Skin skin;
};

std::vector<Ring> to_rings(const std::vector<Level>& levels, float scale, float girth) {
  std::vector<Ring> rings;
  rings.reserve(levels.size());
  const float thick = scale * girth;
  for (const Level& level : levels) {
    rings.push_back({scale * Eigen::Vector3f(level.x, 0.0F, level.z), thick * level.half_width,
                     thick * level.front, thick * level.back, level.skin, 2.3F});
  }
  return rings;
}

/// Hips and seat of trousers.
void add_hips(float scale, float girth, SkinnedMesh& mesh) {
  const Skin pelvis = skin_of(kPelvis);
  const std::vector<Level> levels{{0.835F, -0.005F, 0.100F, 0.066F, 0.088F, pelvis},
                                  {0.860F, -0.005F, 0.152F, 0.090F, 0.120F, pelvis},
                                  {0.905F, -0.005F, 0.172F, 0.102F, 0.130F, pelvis},
                                  {0.955F, -0.005F, 0.165F, 0.104F, 0.114F, pelvis},
                                  {0.995F, -0.005F, 0.142F, 0.094F, 0.092F, pelvis}};
  TubeStyle style;
  style.sides = 24;
  style.material = material_of(BodyMaterial::kBottom);
  style.texture_height_m = kBottomTextureM * scale;
  add_tube(mesh, refined(to_rings(levels, scale, girth), 2), style);
}

/// A skirt swings with both thighs.
void add_skirt(float scale, float girth, SkinnedMesh& mesh) {
  const Skin pelvis = skin_of(kPelvis);
  const std::vector<Level> levels{{0.530F, 0.0F, 0.222F, 0.165F, 0.175F, pelvis},
                                  {0.640F, 0.0F, 0.212F, 0.152F, 0.165F, pelvis},
                                  {0.760F, 0.0F, 0.202F, 0.136F, 0.154F, pelvis},
                                  {0.880F, -0.005F, 0.186F, 0.117F, 0.138F, pelvis},
                                  {0.955F, -0.005F, 0.166F, 0.106F, 0.116F, pelvis},
                                  {0.995F, -0.005F, 0.142F, 0.094F, 0.092F, pelvis}};
  TubeStyle style;
  style.sides = 28;
  style.material = material_of(BodyMaterial::kBottom);
  style.texture_height_m = kBottomTextureM * scale;
  const std::size_t first = add_tube(mesh, refined(to_rings(levels, scale, girth), 3), style);
  for (std::size_t i = first; i < mesh.skins.size(); ++i) {
    const Eigen::Vector3f point = mesh.rest.points[i] / scale;
    const double thighs = eased((0.95 - point.z()) / 0.2);
    const double left = eased((point.y() + 0.09) / 0.18);
    mesh.skins[i] =
        skin_of_three({kPelvis, index_of(Side::kLeft, LimbBone::kThigh),
                       index_of(Side::kRight, LimbBone::kThigh)},
                      {static_cast<float>(1.0 - thighs), static_cast<float>(thighs * left),
                       static_cast<float>(thighs * (1.0 - left))});
  }
}

/// Shoulders of a shirt follow the arms a little, so that no edge shows where sleeves begin.
void soften_shoulders(float scale, std::size_t first, SkinnedMesh& mesh) {
  for (std::size_t i = first; i < mesh.skins.size(); ++i) {
    const Eigen::Vector3f point = mesh.rest.points[i] / scale;
    const double share = 0.45 * eased((std::abs(point.y()) - 0.09) / 0.10) *
                         eased((point.z() - 1.22) / 0.14) * eased((1.50 - point.z()) / 0.05);
    if (share <= 0.0) continue;
    const Side side = point.y() > 0.0F ? Side::kLeft : Side::kRight;
    mesh.skins[i] =
        skin_of_three({kChest, kSpine, index_of(side, LimbBone::kUpperArm)},
                      {static_cast<float>(1.0 - share), 0.0F, static_cast<float>(share)});
  }
}

std::vector<Level> shirt_levels(const Look& look) {
  const bool is_jacket = look.top == Top::kJacket;
  const float loose = look.top == Top::kTShirt || look.top == Top::kShirt ? 0.0F : 0.007F;
  const float hem = is_jacket ? 0.86F : 0.90F;
  const float bust = look.is_feminine ? 0.022F : 0.0F;
  const float waist = look.is_feminine ? -0.010F : 0.004F;
  const auto shoulder = static_cast<float>(look.shoulder_width);
  const auto level = [&](float z, float x, const Eigen::Vector3f& oval, const Skin& skin) {
    return Level{z, x, oval.x() + loose, oval.y() + loose, oval.z() + loose, skin};
  };
  return {
      level(hem, -0.005F, {0.184F, 0.122F, 0.138F}, skin_of(kPelvis)),
      level(0.95F, -0.005F, {0.178F, 0.118F, 0.127F}, skin_of(kPelvis)),
      level(1.01F, -0.005F, {0.164F + waist, 0.114F, 0.110F}, skin_between(kPelvis, kSpine, 0.5F)),
      level(1.09F, -0.005F, {0.152F + waist, 0.110F, 0.100F}, skin_of(kSpine)),
      level(1.19F, -0.008F, {0.160F, 0.114F + 0.5F * bust, 0.104F},
            skin_between(kSpine, kChest, 0.5F)),
      level(1.27F, -0.010F, {0.172F * shoulder, 0.119F + bust, 0.112F}, skin_of(kChest)),
      level(1.34F, -0.012F, {0.183F * shoulder, 0.117F + 0.4F * bust, 0.118F}, skin_of(kChest)),
      level(1.395F, -0.015F, {0.184F * shoulder, 0.100F, 0.110F}, skin_of(kChest)),
      level(1.435F, -0.018F, {0.158F * shoulder, 0.080F, 0.094F}, skin_of(kChest)),
      level(1.465F, -0.018F, {0.110F, 0.066F, 0.078F}, skin_between(kChest, kNeck, 0.2F)),
      level(1.478F, -0.016F, {0.068F, 0.060F, 0.064F}, skin_between(kChest, kNeck, 0.4F))};
}

/// A collar or neckband around the neck.
void add_collar(const Look& look, float scale, SkinnedMesh& mesh) {
  const bool stands = look.top == Top::kShirt || look.top == Top::kJacket;
  const float height = stands ? 0.020F : 0.004F;
  const Skin skin = skin_between(kChest, kNeck, 0.4F);
  const std::vector<Level> levels{{1.462F, -0.016F, 0.080F, 0.069F, 0.073F, skin},
                                  {1.474F + 0.4F * height, -0.013F, 0.070F, 0.066F, 0.066F, skin},
                                  {1.474F + height, -0.012F, 0.066F, 0.065F, 0.063F, skin}};
  TubeStyle style;
  style.material = material_of(BodyMaterial::kSleeve);
  style.texture_height_m = kSleeveTextureM * scale;
  add_tube(mesh, to_rings(levels, scale, 1.0F), style);
}

}  // namespace

void add_trunk(const Skeleton& skeleton, const Look& look, SkinnedMesh& mesh) {
  const auto scale = static_cast<float>(skeleton.scale);
  const auto girth = static_cast<float>(look.girth);
  if (look.bottom == Bottom::kSkirt) {
    add_skirt(scale, girth, mesh);
  } else {
    add_hips(scale, girth, mesh);
  }
  TubeStyle style;
  style.sides = 30;
  style.material = material_of(BodyMaterial::kTop);
  style.texture_height_m = kTopTextureM * scale;
  const std::size_t first =
      add_tube(mesh, refined(to_rings(shirt_levels(look), scale, girth), 2), style);
  soften_shoulders(scale, first, mesh);
  add_collar(look, scale, mesh);
}

}  // namespace tsg::simulation
