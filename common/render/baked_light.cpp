#include "common/render/baked_light.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/core/utility.hpp>

#include "common/render/sampling.hpp"

namespace tsg::render {
namespace {

constexpr int kLampSamples = 16;
constexpr int kFirstBounceRays = 32;
constexpr int kSecondBounceRays = 96;  // the visible result: it must not look mottled
constexpr float kWorthwhile = 0.01F;   // lamps below this share of the strongest one are left out
// Bounces beyond the second: what is left of a geometric series with the usual reflection of a
// furnished room, 0.4.
constexpr float kAllBounces = 1.15F;
constexpr float kLiftM = 2e-3F;

void for_each(std::size_t count, const std::function<void(std::size_t)>& work) {
  cv::parallel_for_(cv::Range(0, static_cast<int>(count)), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) work(static_cast<std::size_t>(i));
  });
}

/// What a surface throws back at a hit.
Eigen::Vector3f thrown_back(const Layer& layer,
                            const Hit& hit,
                            const std::vector<Eigen::Vector3f>& light) {
  const Triangle& triangle = layer.mesh.triangles[hit.triangle];
  return at_hit(triangle, hit, light).cwiseProduct(layer.reflection[triangle.material]);
}

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

class Baker {
 public:
  Baker(const Layer& layer, const std::vector<Lamp>& lamps) : layer_(layer), lamps_(lamps) {}

  BakedLight bake() {
    const std::size_t count = layer_.mesh.points.size();
    light_.places = places_of(layer_.mesh);
    light_.strong.resize(count);
    light_.rest.resize(count, Eigen::Vector3f::Zero());
    light_.total.resize(count);
    light_.bounced.resize(count);
    for_each(count, [this](std::size_t i) { add_lamps(i); });
    const std::vector<Eigen::Vector3f> direct = light_.total;
    for_each(count, [&](std::size_t i) {
      light_.total[i] = direct[i] + bounced<kFirstBounceRays>(i, direct);
    });
    const std::vector<Eigen::Vector3f> once = light_.total;
    for_each(count, [&](std::size_t i) {
      light_.bounced[i] = kAllBounces * bounced<kSecondBounceRays>(i, once);
      light_.total[i] = direct[i] + light_.bounced[i];
    });
    return std::move(light_);
  }

 private:
  void add_lamps(std::size_t i) {
    const SurfacePoint& point = light_.places[i];
    StrongLamps& strong = light_.strong[i] = strongest_lamps(lamps_, point);
    const float worthwhile = kWorthwhile * strong.front().light.sum();
    for (std::uint32_t lamp = 0; lamp < lamps_.size(); ++lamp) {
      if (!(open_light(lamps_[lamp], point).sum() > worthwhile)) continue;
      const auto salt = static_cast<std::uint32_t>(i);
      const Eigen::Vector3f light =
          lamp_light(lamps_[lamp], point, layer_.rays, kLampSamples, salt);
      const auto known = std::ranges::find_if(strong, [&](const LampShare& share) {
        return share.lamp == lamp && share.light.sum() > 0.0F;
      });
      if (known == strong.end()) {
        light_.rest[i] += light;
      } else {
        known->light = light;
      }
    }
    light_.total[i] = light_.rest[i];
    for (const LampShare& share : strong) light_.total[i] += share.light;
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
          point.position + kLiftM * point.normal,
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

constexpr float kSpacingM = 0.8F;
constexpr int kProbeRays = 128;
constexpr float kTooCloseM = 0.03F;

Eigen::Vector3f axis(std::size_t face) {
  const auto along = static_cast<Eigen::Index>(face / 2);
  return (face % 2 == 0 ? 1.0F : -1.0F) * Eigen::Vector3f::Unit(along);
}

}  // namespace

BakedLight bake_light(const Layer& layer, const std::vector<Lamp>& lamps) {
  return Baker(layer, lamps).bake();
}

BouncedLightField::BouncedLightField(const Layer& layer, const BakedLight& light) {
  Eigen::Vector3f low = Eigen::Vector3f::Zero();
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
  if (!layer.mesh.points.empty()) low = high = layer.mesh.points.front();
  for (const Eigen::Vector3f& point : layer.mesh.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  origin_m_ = low + Eigen::Vector3f::Constant(0.3F * kSpacingM);
  size_ = ((high - low) / kSpacingM).array().ceil().cast<int>().max(1);
  probes_.resize(static_cast<std::size_t>(size_.prod()));
  for_each(probes_.size(), [&](std::size_t i) { probes_[i] = measure(layer, light, i); });
}

Eigen::Vector3f BouncedLightField::position(std::size_t index) const {
  const auto i = static_cast<int>(index);
  const Eigen::Vector3i cell(i % size_.x(), i / size_.x() % size_.y(), i / size_.x() / size_.y());
  return origin_m_ + kSpacingM * cell.cast<float>();
}

std::size_t BouncedLightField::index_of(const Eigen::Vector3i& cell) const {
  return static_cast<std::size_t>((cell.z() * size_.y() + cell.y()) * size_.x() + cell.x());
}

BouncedLightField::Probe BouncedLightField::measure(const Layer& layer,
                                                    const BakedLight& light,
                                                    std::size_t index) const {
  std::array<Ray, kProbeRays> rays;
  std::array<Hit, kProbeRays> hits;
  for (int k = 0; k < kProbeRays; ++k) {
    rays.at(static_cast<std::size_t>(k)) = {position(index),
                                            sphere_direction(spread_point(k, kProbeRays, 0))};
  }
  layer.rays.cast(rays, hits, RayScene::Likeness::kScattered);
  Probe probe;
  probe.light.fill(Eigen::Vector3f::Zero());
  int backs = 0;
  for (std::size_t k = 0; k < kProbeRays; ++k) {
    if (!hits.at(k).is_hit()) continue;
    const Triangle& triangle = layer.mesh.triangles[hits.at(k).triangle];
    const Eigen::Vector3f normal = at_hit(triangle, hits.at(k), layer.mesh.normals);
    if (normal.dot(rays.at(k).direction) > 0.0F || hits.at(k).distance < kTooCloseM) {
      ++backs;
      continue;
    }
    const Eigen::Vector3f radiance = thrown_back(layer, hits.at(k), light.total);
    for (std::size_t face = 0; face < probe.light.size(); ++face) {
      const float share = axis(face).dot(rays.at(k).direction);
      // 4 / N is what makes the cosine-weighted mean over a sphere's rays that of a hemisphere.
      if (share > 0.0F) probe.light.at(face) += 4.0F / kProbeRays * share * radiance;
    }
  }
  // A probe that sees many backs of surfaces sits inside something.
  probe.weight = 4 * backs < kProbeRays ? 1.0F : 0.0F;
  return probe;
}

Eigen::Vector3f BouncedLightField::at(const SurfacePoint& point) const {
  const Eigen::Vector3f place = ((point.position - origin_m_) / kSpacingM)
                                    .cwiseMax(0.0F)
                                    .cwiseMin((size_ - Eigen::Vector3i::Ones()).cast<float>());
  const Eigen::Vector3i cell =
      place.cast<int>().cwiseMin(size_ - Eigen::Vector3i::Constant(2)).cwiseMax(0);
  const Eigen::Vector3f share = place - cell.cast<float>();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weights = 0.0F;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i step(static_cast<int>(corner & 1U), static_cast<int>(corner >> 1U & 1U),
                               static_cast<int>(corner >> 2U));
    const Probe& probe = probes_[index_of((cell + step).cwiseMin(size_ - Eigen::Vector3i::Ones()))];
    const Eigen::Vector3f near = (step.array() == 1).select(share, Eigen::Vector3f::Ones() - share);
    const float weight = probe.weight * (near.prod() + 1e-4F);
    weights += weight;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const float along = point.normal[i];
      const auto face = static_cast<std::size_t>(2 * i + (along < 0.0F ? 1 : 0));
      sum += weight * along * along * probe.light.at(face);
    }
  }
  return weights > 0.0F ? Eigen::Vector3f(sum / weights) : Eigen::Vector3f::Zero();
}

std::vector<float> bake_openness(const Layer& body) {
  constexpr int kRays = 32;
  constexpr float kReachM = 0.5F;
  std::vector<float> openness(body.mesh.points.size());
  for_each(openness.size(), [&](std::size_t i) {
    const Eigen::Vector3f& normal = body.mesh.normals[i];
    std::array<Ray, kRays> rays;
    std::array<bool, kRays> blocked{};
    for (int k = 0; k < kRays; ++k) {
      const Eigen::Vector2f where = spread_point(k, kRays, static_cast<std::uint32_t>(i));
      rays.at(static_cast<std::size_t>(k)) = {body.mesh.points[i] + kLiftM * normal,
                                              cosine_direction(normal, where), kReachM};
    }
    body.rays.find_blocked(rays, blocked);
    openness[i] = static_cast<float>(std::ranges::count(blocked, false)) / kRays;
  });
  return openness;
}

}  // namespace tsg::render
