#include <algorithm>
#include <array>

#include "common/simulation/people/body_mesh.hpp"
#include "common/simulation/people/body_textures.hpp"
#include "common/simulation/people/loft.hpp"

namespace tsg::simulation {
namespace {

/// A cross-section of a limb: how far down it is from its upper joint, for a body of 1.75 m.
struct Station {
  float down;
  float half_width;
  float front;
  float back;
};

/// Shares of two bones around their joint, which bend over `half_bend` each way.
Skin around_joint(std::size_t upper, std::size_t lower, float beyond, float half_bend) {
  const float share = std::clamp(0.5F + 0.5F * beyond / half_bend, 0.0F, 1.0F);
  return skin_between(upper, lower, share * share * (3.0F - 2.0F * share));
}

constexpr float kThighLength = 0.41F;
constexpr float kUpperArmLength = 0.285F;

Skin leg_skin(Side side, float down) {
  const std::size_t thigh = index_of(side, LimbBone::kThigh);
  if (down < 0.2F) return around_joint(index_of(Bone::kPelvis), thigh, down - 0.02F, 0.08F);
  return around_joint(thigh, index_of(side, LimbBone::kShin), down - kThighLength, 0.055F);
}

Skin arm_skin(Side side, float down) {
  const std::size_t upper = index_of(side, LimbBone::kUpperArm);
  if (down < 0.14F) return around_joint(index_of(Bone::kChest), upper, down - 0.01F, 0.07F);
  return around_joint(upper, index_of(side, LimbBone::kLowerArm), down - kUpperArmLength, 0.05F);
}

Station between(const Station& a, const Station& b, float share) {
  const auto mix = [share](float from, float to) { return from + (to - from) * share; };
  return {mix(a.down, b.down), mix(a.half_width, b.half_width), mix(a.front, b.front),
          mix(a.back, b.back)};
}

/// The stations and one half-way between any two.
std::vector<Station> with_halves(const std::vector<Station>& stations) {
  std::vector<Station> result;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    result.push_back(stations[i]);
    result.push_back(between(stations[i], stations[i + 1], 0.5F));
  }
  result.push_back(stations.back());
  return result;
}

/// From the ankle up to the inside of the hips.
std::vector<Station> leg_stations(bool is_bare) {
  if (is_bare) {
    return {{0.825F, 0.034F, 0.036F, 0.040F}, {0.74F, 0.036F, 0.038F, 0.042F},
            {0.62F, 0.050F, 0.046F, 0.062F},  {0.53F, 0.054F, 0.050F, 0.064F},
            {0.46F, 0.052F, 0.056F, 0.052F},  {0.41F, 0.054F, 0.060F, 0.052F},
            {0.35F, 0.060F, 0.064F, 0.060F},  {0.22F, 0.074F, 0.078F, 0.080F},
            {0.10F, 0.084F, 0.088F, 0.096F},  {-0.01F, 0.074F, 0.080F, 0.090F}};
  }
  return {{0.855F, 0.060F, 0.064F, 0.066F}, {0.80F, 0.058F, 0.058F, 0.066F},
          {0.70F, 0.056F, 0.055F, 0.068F},  {0.58F, 0.060F, 0.058F, 0.074F},
          {0.49F, 0.062F, 0.064F, 0.068F},  {0.44F, 0.061F, 0.068F, 0.062F},
          {0.41F, 0.062F, 0.070F, 0.061F},  {0.37F, 0.064F, 0.071F, 0.063F},
          {0.30F, 0.072F, 0.076F, 0.074F},  {0.20F, 0.082F, 0.086F, 0.088F},
          {0.10F, 0.089F, 0.092F, 0.102F},  {-0.02F, 0.078F, 0.086F, 0.096F}};
}

/// From the wrist (of a short sleeve: from above the elbow) up to the inside of the shoulder.
std::vector<Station> arm_stations(const Look& look, bool is_bare) {
  if (is_bare) {
    return {{0.545F, 0.022F, 0.029F, 0.029F}, {0.48F, 0.025F, 0.032F, 0.031F},
            {0.40F, 0.033F, 0.037F, 0.037F},  {0.33F, 0.037F, 0.040F, 0.040F},
            {0.285F, 0.036F, 0.038F, 0.040F}, {0.22F, 0.038F, 0.041F, 0.042F},
            {0.12F, 0.042F, 0.046F, 0.048F},  {0.04F, 0.044F, 0.050F, 0.050F}};
  }
  const bool is_short = look.top == Top::kTShirt;
  const float loose = look.top == Top::kShirt ? 0.0F : 0.005F;
  const std::vector<Station> upper{
      {0.20F, 0.052F, 0.054F, 0.056F},  {0.12F, 0.054F, 0.059F, 0.061F},
      {0.06F, 0.053F, 0.062F, 0.063F},  {0.03F, 0.047F, 0.060F, 0.061F},
      {0.005F, 0.037F, 0.053F, 0.054F}, {-0.015F, 0.026F, 0.042F, 0.043F},
      {-0.03F, 0.014F, 0.026F, 0.027F}};
  std::vector<Station> all;
  if (!is_short) {
    all = {{0.535F, 0.036F + loose, 0.038F + loose, 0.038F + loose},
           {0.50F, 0.038F + loose, 0.040F + loose, 0.041F + loose},
           {0.40F, 0.043F + loose, 0.045F + loose, 0.047F + loose},
           {0.33F, 0.047F + loose, 0.048F + loose, 0.050F + loose},
           {0.285F, 0.047F + loose, 0.048F + loose, 0.051F + loose},
           {0.24F, 0.048F + loose, 0.050F + loose, 0.051F + loose}};
  }
  all.insert(all.end(), upper.begin(), upper.end());
  return all;
}

}  // namespace

void add_leg(const Skeleton& skeleton, const Look& look, Side side, SkinnedMesh& mesh) {
  const auto scale = static_cast<float>(skeleton.scale);
  const auto girth = scale * static_cast<float>(look.girth);
  const Eigen::Vector3f hip = skeleton.joint(side, LimbBone::kThigh).cast<float>();
  std::vector<Ring> rings;
  for (const Station& station : with_halves(leg_stations(look.bottom == Bottom::kSkirt))) {
    rings.push_back({hip - scale * Eigen::Vector3f(0.0F, 0.0F, station.down),
                     girth * station.half_width, girth * station.front, girth * station.back,
                     leg_skin(side, station.down), 2.1F});
  }
  TubeStyle style;
  style.sides = 18;
  style.material = material_of(BodyMaterial::kLegs);
  style.texture_height_m = kBottomTextureM * scale;
  add_tube(mesh, rings, style);
}

void add_arm(const Skeleton& skeleton, const Look& look, Side side, SkinnedMesh& mesh) {
  const auto scale = static_cast<float>(skeleton.scale);
  const auto girth = scale * static_cast<float>(look.girth);
  const Eigen::Vector3f shoulder = skeleton.joint(side, LimbBone::kUpperArm).cast<float>();
  const Eigen::Vector3f along = rest_arm_direction(side).cast<float>();
  const Eigen::Vector3f left = (-along).cross(Eigen::Vector3f::UnitX());
  const Eigen::Vector3f inwards = static_cast<float>(-sign_of(side)) * left;
  const auto add = [&](bool is_bare, BodyMaterial material) {
    std::vector<Ring> rings;
    for (const Station& station : with_halves(arm_stations(look, is_bare))) {
      // The end in the shoulder bends inwards, which makes it round.
      const float above = std::max(0.0F, 0.05F - station.down);
      const Eigen::Vector3f centre =
          shoulder + scale * (station.down * along + 5.0F * above * above * inwards);
      rings.push_back({centre, girth * station.half_width, girth * station.front,
                       girth * station.back, arm_skin(side, station.down), 2.1F});
    }
    TubeStyle style;
    style.sides = 16;
    style.side = left;
    style.material = material_of(material);
    style.texture_height_m = kSleeveTextureM * scale;
    add_tube(mesh, rings, style);
  };
  add(false, BodyMaterial::kSleeve);
  if (look.top == Top::kTShirt) add(true, BodyMaterial::kSkin);
}

}  // namespace tsg::simulation
