#include "common/simulation/people/loft.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/simulation/people/easing.hpp"

namespace tsg::simulation {
namespace {

float power(double base, double exponent) {
  return static_cast<float>(std::copysign(std::pow(std::abs(base), exponent), base));
}

Eigen::Vector3f ring_point(const Ring& ring, const TubeStyle& style, double angle) {
  const double exponent = 2.0 / static_cast<double>(ring.squareness);
  const float ahead = power(std::cos(angle), exponent);
  const float aside = power(std::sin(angle), exponent);
  const float depth = ahead > 0.0F ? ring.front_m : ring.back_m;
  return ring.centre_m + ahead * depth * style.depth + aside * ring.half_width_m * style.side;
}

void join_rings(render::Mesh& mesh,
                std::uint32_t lower,
                std::uint32_t columns,
                std::uint32_t material) {
  const std::uint32_t upper = lower + columns + 1;
  for (std::uint32_t i = 0; i < columns; ++i) {
    mesh.triangles.push_back({{lower + i, lower + i + 1, upper + i + 1}, material});
    mesh.triangles.push_back({{lower + i, upper + i + 1, upper + i}, material});
  }
}

/// The end of a tube, drawn in and bulging a little.
Ring cap_ring(const Ring& end, const Ring& inner, float share) {
  Ring cap = end;
  const float radius = std::min(end.half_width_m, 0.5F * (end.front_m + end.back_m));
  const Eigen::Vector3f outwards = (end.centre_m - inner.centre_m).normalized();
  const float drawn_in = std::sqrt(std::max(0.0F, 1.0F - share * share));
  cap.centre_m = end.centre_m + 0.35F * share * radius * outwards;
  cap.half_width_m *= drawn_in;
  cap.front_m *= drawn_in;
  cap.back_m *= drawn_in;
  return cap;
}

std::vector<Ring> with_caps(const std::vector<Ring>& rings) {
  const Ring& first = rings.front();
  const Ring& last = rings.back();
  std::vector<Ring> result;
  for (const float share : {1.0F, 0.75F}) result.push_back(cap_ring(first, rings[1], share));
  result.insert(result.end(), rings.begin(), rings.end());
  for (const float share : {0.75F, 1.0F}) {
    result.push_back(cap_ring(last, rings[rings.size() - 2], share));
  }
  return result;
}

/// Catmull-Rom between b and c.
template <typename T>
T spline(const std::array<T, 4>& p, float u) {
  const float uu = u * u;
  const float uuu = uu * u;
  return 0.5F * ((2.0F * p[1]) + (p[2] - p[0]) * u +
                 (2.0F * p[0] - 5.0F * p[1] + 4.0F * p[2] - p[3]) * uu +
                 (3.0F * p[1] - p[0] - 3.0F * p[2] + p[3]) * uuu);
}

using Shape = Eigen::Matrix<float, 7, 1>;

Shape shape_of(const Ring& ring) {
  Shape shape;
  shape << ring.centre_m, ring.half_width_m, ring.front_m, ring.back_m, ring.squareness;
  return shape;
}

Skin mixed_skin(const Skin& a, const Skin& b, float share) {
  std::map<std::uint8_t, float> weights;
  for (std::size_t i = 0; i < 3; ++i) {
    weights[a.bones.at(i)] += (1.0F - share) * a.weights.at(i);
    weights[b.bones.at(i)] += share * b.weights.at(i);
  }
  std::vector<std::pair<float, std::uint8_t>> by_weight;
  by_weight.reserve(weights.size());
  for (const auto& [bone, weight] : weights) by_weight.emplace_back(-weight, bone);
  std::sort(by_weight.begin(), by_weight.end());
  Skin skin;
  float sum = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [weight, bone] = by_weight[std::min(i, by_weight.size() - 1)];
    skin.bones.at(i) = bone;
    skin.weights.at(i) = i < by_weight.size() ? -weight : 0.0F;
    sum += skin.weights.at(i);
  }
  for (float& weight : skin.weights) weight /= sum;
  return skin;
}

}  // namespace

std::size_t add_tube(SkinnedMesh& mesh, const std::vector<Ring>& rings, const TubeStyle& style) {
  const std::vector<Ring> all = style.is_capped ? with_caps(rings) : rings;
  float length = 0.0F;
  for (std::size_t i = 1; i < all.size(); ++i) {
    length += (all[i].centre_m - all[i - 1].centre_m).norm();
  }
  const std::size_t first = mesh.rest.points.size();
  const auto columns = static_cast<std::uint32_t>(style.sides);
  float along = 0.0F;
  for (std::size_t row = 0; row < all.size(); ++row) {
    if (row > 0) along += (all[row].centre_m - all[row - 1].centre_m).norm();
    if (row > 0) {
      const auto lower = static_cast<std::uint32_t>(mesh.rest.points.size()) - columns - 1;
      join_rings(mesh.rest, lower, columns, style.material);
    }
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns;
      mesh.rest.points.push_back(ring_point(all[row], style, kPi * (2.0 * u - 1.0)));
      mesh.rest.uvs.emplace_back(static_cast<float>(u), (length - along) / style.texture_height_m);
      mesh.skins.push_back(all[row].skin);
    }
  }
  return first;
}

void finish_normals(SkinnedMesh& mesh) {
  render::Mesh& rest = mesh.rest;
  rest.normals.assign(rest.points.size(), Eigen::Vector3f::Zero());
  for (const render::Triangle& triangle : rest.triangles) {
    const auto& [a, b, c] = triangle.corners;
    const Eigen::Vector3f weighted =
        (rest.points[b] - rest.points[a]).cross(rest.points[c] - rest.points[a]);
    for (const std::uint32_t corner : triangle.corners) rest.normals[corner] += weighted;
  }
  // Points in one place: seams of tubes and their ends. Keyed by a tenth of a millimetre.
  std::map<std::array<long, 4>, Eigen::Vector3f> sums;
  std::vector<std::array<long, 4>> keys(rest.points.size());
  std::vector<long> materials(rest.points.size(), -1);
  for (const render::Triangle& triangle : rest.triangles) {
    for (const std::uint32_t corner : triangle.corners) materials[corner] = triangle.material;
  }
  for (std::size_t i = 0; i < rest.points.size(); ++i) {
    const Eigen::Vector3f scaled = 1e4F * rest.points[i];
    keys[i] = {std::lround(scaled.x()), std::lround(scaled.y()), std::lround(scaled.z()),
               materials[i]};
    auto [sum, is_new] = sums.try_emplace(keys[i], Eigen::Vector3f::Zero());
    sum->second += rest.normals[i];
  }
  for (std::size_t i = 0; i < rest.points.size(); ++i) {
    const Eigen::Vector3f& sum = sums.at(keys[i]);
    rest.normals[i] = sum.norm() > 1e-12F ? Eigen::Vector3f(sum.normalized())
                                          : Eigen::Vector3f(Eigen::Vector3f::UnitZ());
  }
}

std::vector<Ring> refined(const std::vector<Ring>& rings, int times) {
  std::vector<Ring> result;
  const std::size_t last = rings.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const std::array<Shape, 4> around{shape_of(rings[i == 0 ? 0 : i - 1]), shape_of(rings[i]),
                                      shape_of(rings[i + 1]),
                                      shape_of(rings[std::min(i + 2, last)])};
    for (int k = 0; k < times; ++k) {
      const float u = static_cast<float>(k) / static_cast<float>(times);
      const Shape shape = spline(around, u);
      result.push_back({shape.head<3>(), shape[3], shape[4], shape[5],
                        mixed_skin(rings[i].skin, rings[i + 1].skin, u), shape[6]});
    }
  }
  result.push_back(rings[last]);
  return result;
}

}  // namespace tsg::simulation
