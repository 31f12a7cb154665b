#include "common/render/bounced_light_field.hpp"

#include <algorithm>
#include <array>

#include "common/render/parallel.hpp"
#include "common/render/sampling.hpp"

namespace tsg::render {
namespace {

constexpr float kSpacingM = 0.8F;
constexpr int kProbeRays = 128;
constexpr float kTooCloseM = 0.03F;

Eigen::Vector3f axis(std::size_t face) {
  const auto along = static_cast<Eigen::Index>(face / 2);
  return (face % 2 == 0 ? 1.0F : -1.0F) * Eigen::Vector3f::Unit(along);
}

}  // namespace

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
  for_each_index(probes_.size(), [&](std::size_t i) { probes_[i] = measure(layer, light, i); });
}

Eigen::Vector3f BouncedLightField::position(std::size_t index) const {
  const auto i = static_cast<int>(index);
  const Eigen::Vector3i cell(i % size_.x(), i / size_.x() % size_.y(), i / size_.x() / size_.y());
  return origin_m_ + kSpacingM * cell.cast<float>();
}

std::size_t BouncedLightField::index_of(const Eigen::Vector3i& cell) const {
  const int index = (cell.z() * size_.y() + cell.y()) * size_.x() + cell.x();
  return static_cast<std::size_t>(index);
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

}  // namespace tsg::render
