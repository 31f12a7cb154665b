#include "common/render/baked_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/render/parallel.hpp"
#include "common/render/sampling.hpp"

namespace tsg::render {
namespace {

// Lamps that are wholly in sight or wholly hidden, most of them, are seen to be so by few rays.
constexpr int kFirstLampSamples = 4;
constexpr int kLampSamples = 16;
constexpr std::size_t kMostLamps = 12;  // of a point; the others are far away or behind walls
constexpr float kWorthwhile = 0.02F;    // lamps below this share of the strongest one are left out
// Few rays, and their errors averaged with the neighbours', instead of many rays.
constexpr int kFirstBounceRays = 12;
constexpr int kSecondBounceRays = 24;
constexpr int kSmoothings = 4;
// Bounces beyond the second: what is left of a geometric series with the usual reflection of a
// furnished room, 0.4.
constexpr float kAllBounces = 1.15F;

/// Corners, drawn a little into the faces around them: a corner at the foot of a wall lies on the
/// floor as well, and rays from there would start inside it.
std::vector<SurfacePoint> places_of(const Mesh& mesh) {
  constexpr float kInwards = 0.25F;
  std::vector<Eigen::Vector3f> centres(mesh.points.size(), Eigen::Vector3f::Zero());
  std::vector<float> faces(mesh.points.size(), 0.0F);
  for (const Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    const Eigen::Vector3f centre = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0F;
    for (const std::uint32_t corner : triangle.corners) {
      centres[corner] += centre;
      faces[corner] += 1.0F;
    }
  }
  std::vector<SurfacePoint> places;
  places.reserve(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Eigen::Vector3f inwards = faces[i] > 0.0F
                                        ? Eigen::Vector3f(centres[i] / faces[i] - mesh.points[i])
                                        : Eigen::Vector3f(Eigen::Vector3f::Zero());
    // Along the surface only: on a bent one the centres lie below it.
    const Eigen::Vector3f along = inwards - inwards.dot(mesh.normals[i]) * mesh.normals[i];
    places.push_back({mesh.points[i] + kInwards * along, mesh.normals[i]});
  }
  return places;
}

/// Averages each corner with those that it shares triangles with. Faces that meet at an edge have
/// corners of their own, so that light does not creep around it.
void smooth(const std::vector<Triangle>& triangles, std::vector<Eigen::Vector3f>& values) {
  std::vector<Eigen::Vector3f> sums = values;
  std::vector<float> weights(values.size(), 1.0F);
  for (const Triangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.corners;
    const Eigen::Vector3f sum = values[a] + values[b] + values[c];
    for (const std::uint32_t corner : triangle.corners) {
      sums[corner] += sum;
      weights[corner] += 3.0F;
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = sums[i] / weights[i];
}

class Baker {
 public:
  Baker(const Layer& layer, const std::vector<Lamp>& lamps) : layer_(layer), lamps_(lamps) {}

  BakedLight bake() {
    const std::size_t count = layer_.mesh.points.size();
    light_.places = places_of(layer_.mesh);
    light_.strong.resize(count);
    light_.rest.assign(count, Eigen::Vector3f::Zero());
    light_.total.resize(count);
    light_.bounced.resize(count);
    for_each_index(count, [this](std::size_t i) { add_lamps(i); });
    const std::vector<Eigen::Vector3f> direct = light_.total;
    add_bounce<kFirstBounceRays>(direct);
    add_bounce<kSecondBounceRays>(direct);
    for (std::size_t i = 0; i < count; ++i) {
      light_.bounced[i] *= kAllBounces;
      light_.total[i] = direct[i] + light_.bounced[i];
    }
    return std::move(light_);
  }

 private:
  void add_lamps(std::size_t i) {
    const SurfacePoint& point = light_.places[i];
    const std::vector<LampShare> open = worthwhile_lamps(point);
    const auto salt = static_cast<std::uint32_t>(i);
    light_.total[i] = Eigen::Vector3f::Zero();
    for (std::size_t k = 0; k < open.size(); ++k) {
      const Eigen::Vector3f light = soft_light(open[k], point, salt);
      light_.total[i] += light;
      if (k < kStrongLamps) {
        light_.strong[i].at(k) = {open[k].lamp, light};
      } else {
        light_.rest[i] += light;
      }
    }
  }

  /// The lamps that matter if nothing stands in between, brightest first.
  [[nodiscard]] std::vector<LampShare> worthwhile_lamps(const SurfacePoint& point) const {
    std::vector<LampShare> open;
    for (std::uint32_t lamp = 0; lamp < lamps_.size(); ++lamp) {
      const Eigen::Vector3f light = open_light(lamps_[lamp], point);
      if (light.sum() > 0.0F) open.push_back({lamp, light});
    }
    std::ranges::stable_sort(
        open, [](const LampShare& a, const LampShare& b) { return a.light.sum() > b.light.sum(); });
    while (open.size() > kMostLamps ||
           (!open.empty() && open.back().light.sum() < kWorthwhile * open.front().light.sum())) {
      open.pop_back();
    }
    return open;
  }

  [[nodiscard]] Eigen::Vector3f soft_light(const LampShare& open,
                                           const SurfacePoint& point,
                                           std::uint32_t salt) const {
    const Lamp& lamp = lamps_[open.lamp];
    const float in_sight = lamp_in_sight(lamp, point, layer_.rays, kFirstLampSamples, salt);
    if (in_sight <= 0.0F) return Eigen::Vector3f::Zero();
    if (in_sight >= 1.0F) return open.light;
    return lamp_light(lamp, point, layer_.rays, kLampSamples, salt);
  }

  /// Brings bounced and total light up to date with one more bounce of the present total.
  template <int kRays>
  void add_bounce(const std::vector<Eigen::Vector3f>& direct) {
    const std::vector<Eigen::Vector3f> light = light_.total;
    for_each_index(light.size(),
                   [&](std::size_t i) { light_.bounced[i] = bounced<kRays>(i, light); });
    for (int i = 0; i < kSmoothings; ++i) smooth(layer_.mesh.triangles, light_.bounced);
    for (std::size_t i = 0; i < light.size(); ++i) light_.total[i] = direct[i] + light_.bounced[i];
  }

  /// What the surfaces around throw back at point i, of the light that falls on them.
  template <int kRays>
  [[nodiscard]] Eigen::Vector3f bounced(std::size_t i,
                                        const std::vector<Eigen::Vector3f>& light) const {
    const SurfacePoint& point = light_.places[i];
    std::array<Ray, kRays> rays;
    std::array<Hit, kRays> hits;
    for (int k = 0; k < kRays; ++k) {
      rays.at(static_cast<std::size_t>(k)) = {
          point.position + kRayLiftM * point.normal,
          cosine_direction(point.normal, spread_point(k, kRays, static_cast<std::uint32_t>(i)))};
    }
    layer_.rays.cast(rays, hits, RayScene::Likeness::kScattered);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const Hit& hit : hits) {
      if (hit.is_hit()) sum += thrown_back(layer_, hit, light);
    }
    return sum / static_cast<float>(kRays);
  }

  const Layer& layer_;
  const std::vector<Lamp>& lamps_;
  BakedLight light_;
};

}  // namespace

BakedLight bake_light(const Layer& layer, const std::vector<Lamp>& lamps) {
  return Baker(layer, lamps).bake();
}

std::vector<float> bake_openness(const Layer& body) {
  constexpr int kRays = 32;
  constexpr float kReachM = 0.5F;
  std::vector<float> openness(body.mesh.points.size());
  for_each_index(openness.size(), [&](std::size_t i) {
    const Eigen::Vector3f& normal = body.mesh.normals[i];
    std::array<Ray, kRays> rays;
    std::array<bool, kRays> blocked{};
    for (int k = 0; k < kRays; ++k) {
      const Eigen::Vector2f where = spread_point(k, kRays, static_cast<std::uint32_t>(i));
      rays.at(static_cast<std::size_t>(k)) = {body.mesh.points[i] + kRayLiftM * normal,
                                              cosine_direction(normal, where), kReachM};
    }
    body.rays.find_blocked(rays, blocked);
    openness[i] = static_cast<float>(std::ranges::count(blocked, false)) / kRays;
  });
  return openness;
}

}  // namespace tsg::render
