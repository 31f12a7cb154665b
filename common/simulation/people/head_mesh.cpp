#include <algorithm>
#include <cmath>

#include "common/simulation/people/body_mesh.hpp"
#include "common/simulation/people/easing.hpp"
#include "common/simulation/people/head_shape.hpp"
#include "common/simulation/people/loft.hpp"

namespace tsg::simulation {
namespace {

std::vector<Ring> head_rings(float scale) {
  std::vector<Ring> rings;
  for (const HeadLevel& level : head_levels()) {
    rings.push_back({scale * Eigen::Vector3f(level.x, 0.0F, level.z), scale * level.half_width,
                     scale * level.front, scale * level.back, skin_of(kHead), 2.15F});
  }
  return rings;
}

/// A hill on the face: how much `point` (of a body of 1.75 m) rises, for one of `height_m` there.
struct Feature {
  double y_m;
  double z_m;
  double width_m;
  double tall_m;
  double height_m;
};

double rise(const Feature& feature, const Eigen::Vector3f& point) {
  const double y = (std::abs(point.y()) - feature.y_m) / feature.width_m;
  const double z = (point.z() - feature.z_m) / feature.tall_m;
  return feature.height_m * std::exp(-y * y - z * z);
}

/// Nose, eye sockets, brows, cheeks, lips and chin.
void shape_face(float scale, std::size_t first, SkinnedMesh& mesh) {
  constexpr std::array<Feature, 9> kFeatures{{{0.0, 1.600, 0.011, 0.011, 0.017},
                                              {0.0, 1.612, 0.008, 0.020, 0.009},
                                              {0.013, 1.596, 0.006, 0.007, 0.005},
                                              {kEyeAsideM, kEyeHeightM, 0.014, 0.010, -0.008},
                                              {0.026, 1.656, 0.020, 0.008, 0.004},
                                              {0.040, 1.605, 0.016, 0.016, 0.003},
                                              {0.0, 1.572, 0.018, 0.006, 0.004},
                                              {0.0, 1.560, 0.015, 0.006, 0.004},
                                              {0.0, 1.532, 0.018, 0.012, 0.006}}};
  for (std::size_t i = first; i < mesh.rest.points.size(); ++i) {
    const Eigen::Vector3f point = mesh.rest.points[i] / scale;
    const double u = mesh.rest.uvs[i].x();
    mesh.rest.uvs[i].y() = static_cast<float>(face_v(point.z()));
    if (std::abs(u - 0.5) > 0.24) continue;
    double height = 0.0;
    for (const Feature& feature : kFeatures) height += rise(feature, point);
    mesh.rest.points[i].x() += scale * static_cast<float>(height);
  }
}

void add_neck(float scale, float girth, SkinnedMesh& mesh) {
  const auto ring = [&](float z, float x, float radius, const Skin& skin) {
    return Ring{scale * Eigen::Vector3f(x, 0.0F, z),
                scale * girth * radius,
                scale * girth * radius,
                scale * girth * radius * 1.05F,
                skin,
                2.0F};
  };
  TubeStyle style;
  style.material = material_of(BodyMaterial::kSkin);
  style.texture_height_m = 0.3F;
  add_tube(mesh,
           refined({ring(1.435F, -0.020F, 0.068F, skin_of(kChest)),
                    ring(1.475F, -0.014F, 0.058F, skin_between(kChest, kNeck, 0.5F)),
                    ring(1.515F, -0.008F, 0.055F, skin_of(kNeck)),
                    ring(1.550F, -0.002F, 0.056F, skin_between(kNeck, kHead, 0.6F)),
                    ring(1.585F, 0.000F, 0.058F, skin_of(kHead))},
                   2),
           style);
}

void add_ears(float scale, SkinnedMesh& mesh) {
  for (const Side side : kBothSides) {
    const auto out = static_cast<float>(sign_of(side));
    std::vector<Ring> rings;
    for (const auto& [z, size] : {std::pair{1.598F, 0.007F},
                                  {1.612F, 0.012F},
                                  {1.630F, 0.016F},
                                  {1.646F, 0.017F},
                                  {1.656F, 0.012F}}) {
      rings.push_back({scale * Eigen::Vector3f(-0.004F - 0.2F * (z - 1.6F), out * 0.079F, z),
                       scale * 0.009F, scale * size, scale * size, skin_of(kHead)});
    }
    TubeStyle style;
    style.sides = 10;
    style.material = material_of(BodyMaterial::kSkin);
    style.texture_height_m = 0.3F;
    add_tube(mesh, rings, style);
  }
}

/// Height of the edge of the hair at `angle` from the middle of the forehead, 0..pi.
double hairline_m(const Look& look, double angle) {
  const double nape = look.hair == Hair::kShort || look.hair == Hair::kCropped ? 1.565 : 1.545;
  const double forehead = look.is_feminine ? 1.698 : 1.708;
  const double temple = 1.680;
  const double sideburn = look.is_feminine ? 1.600 : 1.622;
  if (angle < 0.95) return mixed_values(forehead, temple, eased((angle - 0.45) / 0.5));
  if (angle < 1.35) return mixed_values(temple, sideburn, eased((angle - 0.95) / 0.4));
  const double over_ear = look.hair == Hair::kShort || look.hair == Hair::kCropped ? 1.655 : 1.62;
  if (angle < 1.75) return mixed_values(sideburn, over_ear, eased((angle - 1.35) / 0.12));
  return mixed_values(over_ear, nape, eased((angle - 1.80) / 0.45));
}

/// A cap of hair: the head's own shape, thicker above the hairline and inside the head below it.
void add_hair_cap(const Look& look, float scale, SkinnedMesh& mesh) {
  const double thickness = look.hair == Hair::kCropped ? 0.005 : 0.014;
  TubeStyle style;
  style.sides = 40;
  style.material = material_of(BodyMaterial::kHair);
  style.texture_height_m = 0.25F * scale;
  const std::size_t first = add_tube(mesh, refined(head_rings(scale), 2), style);
  const Eigen::Vector3f middle = scale * Eigen::Vector3f(-0.005F, 0.0F, 1.64F);
  for (std::size_t i = first; i < mesh.rest.points.size(); ++i) {
    Eigen::Vector3f& point = mesh.rest.points[i];
    const double angle = 2.0 * kPi * std::abs(mesh.rest.uvs[i].x() - 0.5);
    const double above = point.z() / scale - hairline_m(look, angle);
    const double wave = 0.0025 * std::sin(23.0 * angle) * std::sin(90.0 * point.z() + 2.0 * angle);
    const double top = 0.008 * eased((point.z() / scale - 1.68) / 0.07);
    const double share = eased((above + 0.008) / 0.022);
    const double outwards =
        mixed_values(-0.012, thickness + (thickness > 0.01 ? top + wave : 0.0), share);
    point += scale * static_cast<float>(outwards) * (point - middle).normalized();
  }
}

/// Hair that hangs at the sides and behind: a tube whose section is a crescent around the head.
void add_hanging_hair(const Look& look, float scale, SkinnedMesh& mesh) {
  const bool is_long = look.hair == Hair::kLong;
  const auto ring = [&](float z, float half_width, float back, const Skin& skin) {
    return Ring{
        scale * Eigen::Vector3f(0.022F - 0.25F * (1.66F - z) * (is_long ? 0.8F : 0.2F), 0.0F, z),
        scale * half_width,
        -0.45F * scale * back,
        scale * back,
        skin,
        2.6F};
  };
  std::vector<Ring> rings;
  if (is_long) {
    rings = {ring(1.36F, 0.060F, 0.085F, skin_between(kChest, kNeck, 0.1F)),
             ring(1.42F, 0.088F, 0.105F, skin_between(kChest, kNeck, 0.4F)),
             ring(1.49F, 0.094F, 0.118F, skin_between(kNeck, kHead, 0.4F))};
  } else {
    rings = {ring(1.515F, 0.080F, 0.112F, skin_of(kHead))};
  }
  rings.push_back(ring(1.55F, 0.096F, 0.130F, skin_of(kHead)));
  rings.push_back(ring(1.60F, 0.098F, 0.136F, skin_of(kHead)));
  rings.push_back(ring(1.65F, 0.094F, 0.136F, skin_of(kHead)));
  rings.push_back(ring(1.69F, 0.084F, 0.122F, skin_of(kHead)));
  TubeStyle style;
  style.sides = 26;
  style.material = material_of(BodyMaterial::kHair);
  style.texture_height_m = 0.25F * scale;
  add_tube(mesh, refined(rings, 2), style);
}

void add_bun(float scale, SkinnedMesh& mesh) {
  std::vector<Ring> rings;
  for (const auto& [z, radius] : {std::pair{1.675F, 0.018F},
                                  {1.69F, 0.034F},
                                  {1.71F, 0.041F},
                                  {1.73F, 0.036F},
                                  {1.745F, 0.020F}}) {
    rings.push_back({scale * Eigen::Vector3f(-0.125F, 0.0F, z), scale * radius, scale * radius,
                     scale * radius, skin_of(kHead)});
  }
  TubeStyle style;
  style.sides = 14;
  style.material = material_of(BodyMaterial::kHair);
  style.texture_height_m = 0.25F;
  add_tube(mesh, refined(rings, 2), style);
}

}  // namespace

void add_head(const Skeleton& skeleton, const Look& look, SkinnedMesh& mesh) {
  const auto scale = static_cast<float>(skeleton.scale);
  TubeStyle style;
  style.sides = 48;
  style.material = material_of(BodyMaterial::kFace);
  const std::size_t first = add_tube(mesh, refined(head_rings(scale), 2), style);
  shape_face(scale, first, mesh);
  add_neck(scale, look.is_feminine ? 0.88F : 1.0F, mesh);
  add_hair_cap(look, scale, mesh);
  if (look.hair == Hair::kShort || look.hair == Hair::kCropped || look.hair == Hair::kBun) {
    add_ears(scale, mesh);
  }
  if (look.hair == Hair::kBob || look.hair == Hair::kLong) add_hanging_hair(look, scale, mesh);
  if (look.hair == Hair::kBun) add_bun(scale, mesh);
}

}  // namespace tsg::simulation
