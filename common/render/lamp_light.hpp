#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/render/lamp.hpp"
#include "common/render/ray_scene.hpp"

namespace tsg::render {

/// A place on a surface.
struct SurfacePoint {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
};

/// What one lamp gives to a point: irradiance / pi, so that times reflection it is radiance.
struct LampShare {
  std::uint32_t lamp = 0;
  Eigen::Vector3f light = Eigen::Vector3f::Zero();
};

inline constexpr std::size_t kStrongLamps = 3;
using StrongLamps = std::array<LampShare, kStrongLamps>;  ///< brightest first

/// The lamp's light on the point if nothing were in between, by one sample at its centre.
[[nodiscard]] Eigen::Vector3f open_light(const Lamp& lamp, const SurfacePoint& point);

/// The brightest lamps of a point if nothing were in between, and no others.
[[nodiscard]] StrongLamps strongest_lamps(std::span<const Lamp> lamps, const SurfacePoint& point);

/// A ray from the point to the place `where` (unit square) of the lamp.
[[nodiscard]] Ray shadow_ray(const SurfacePoint& point,
                             const Lamp& lamp,
                             const Eigen::Vector2f& where);

/// The lamp's light by `samples` rays against `obstacles`.
[[nodiscard]] Eigen::Vector3f lamp_light(const Lamp& lamp,
                                         const SurfacePoint& point,
                                         const RayScene& obstacles,
                                         int samples,
                                         std::uint32_t salt);

/// Share 0..1 of the lamp that `obstacles` leave in sight.
[[nodiscard]] float lamp_in_sight(const Lamp& lamp,
                                  const SurfacePoint& point,
                                  const RayScene& obstacles,
                                  int samples,
                                  std::uint32_t salt);

}  // namespace tsg::render
