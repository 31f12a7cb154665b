#include "common/render/lamp_light.hpp"

#include <algorithm>
#include <bit>
#include <numbers>

#include "common/core/check.hpp"
#include "common/render/sampling.hpp"

namespace tsg::render {
namespace {

constexpr int kMaxSamples = 32;
constexpr float kShortOfLamp = 0.97F;  // and end before the lamp's own housing

Eigen::Vector3f place_on(const Lamp& lamp, const Eigen::Vector2f& where) {
  return lamp.centre_m + (2.0F * where.x() - 1.0F) * lamp.half_side_a_m +
         (2.0F * where.y() - 1.0F) * lamp.half_side_b_m;
}

/// Light from one place of the lamp, as if all of it were there.
Eigen::Vector3f light_from(const Lamp& lamp,
                           const Eigen::Vector3f& place,
                           const SurfacePoint& point) {
  const Eigen::Vector3f way = place - point.position;
  const float squared = std::max(way.squaredNorm(), 1e-4F);
  const float at_point = point.normal.dot(way);
  const float at_lamp = -lamp.normal.dot(way);
  if (at_point <= 0.0F || at_lamp <= 0.0F) return Eigen::Vector3f::Zero();
  const float form =
      at_point * at_lamp / (squared * squared) * lamp.area_m2() / std::numbers::pi_v<float>;
  return std::min(form, 1.0F) * lamp.radiance_bgr;
}

/// Casts shadow rays to evenly spread places; bit i of the result: place i is in sight.
std::uint32_t places_in_sight(const Lamp& lamp,
                              const SurfacePoint& point,
                              const RayScene& obstacles,
                              int samples,
                              std::uint32_t salt) {
  TSG_CHECK(samples > 0 && samples <= kMaxSamples);
  std::array<Ray, kMaxSamples> rays;
  std::array<bool, kMaxSamples> blocked{};
  const auto count = static_cast<std::size_t>(samples);
  for (std::size_t i = 0; i < count; ++i) {
    rays[i] = shadow_ray(point, lamp, spread_point(static_cast<int>(i), samples, salt));
  }
  obstacles.find_blocked(std::span(rays).first(count), std::span(blocked).first(count));
  std::uint32_t in_sight = 0;
  for (std::size_t i = 0; i < count; ++i) in_sight |= blocked[i] ? 0U : 1U << i;
  return in_sight;
}

}  // namespace

Eigen::Vector3f open_light(const Lamp& lamp, const SurfacePoint& point) {
  return light_from(lamp, lamp.centre_m, point);
}

StrongLamps strongest_lamps(std::span<const Lamp> lamps, const SurfacePoint& point) {
  StrongLamps strongest;
  for (std::uint32_t i = 0; i < lamps.size(); ++i) {
    LampShare share{i, open_light(lamps[i], point)};
    for (LampShare& other : strongest) {
      if (share.light.sum() > other.light.sum()) std::swap(share, other);
    }
  }
  return strongest;
}

Ray shadow_ray(const SurfacePoint& point, const Lamp& lamp, const Eigen::Vector2f& where) {
  const Eigen::Vector3f origin = point.position + kRayLiftM * point.normal;
  return {origin, place_on(lamp, where) - origin, kShortOfLamp};
}

Eigen::Vector3f lamp_light(const Lamp& lamp,
                           const SurfacePoint& point,
                           const RayScene& obstacles,
                           int samples,
                           std::uint32_t salt) {
  const std::uint32_t in_sight = places_in_sight(lamp, point, obstacles, samples, salt);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int i = 0; i < samples; ++i) {
    if ((in_sight >> static_cast<unsigned>(i) & 1U) == 0) continue;
    sum += light_from(lamp, place_on(lamp, spread_point(i, samples, salt)), point);
  }
  return sum / static_cast<float>(samples);
}

float lamp_in_sight(const Lamp& lamp,
                    const SurfacePoint& point,
                    const RayScene& obstacles,
                    int samples,
                    std::uint32_t salt) {
  const std::uint32_t in_sight = places_in_sight(lamp, point, obstacles, samples, salt);
  return static_cast<float>(std::popcount(in_sight)) / static_cast<float>(samples);
}

}  // namespace tsg::render
