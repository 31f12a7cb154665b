#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "common/render/mesh.hpp"

namespace tsg::render {

/// Rays start that far above a surface, in metres, or they would hit it.
inline constexpr float kRayLiftM = 2e-3F;

/// From `origin` along `direction` (any length; distances count in it) as far as `max_distance`.
struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
  float max_distance = std::numeric_limits<float>::infinity();
};

/// Where a ray first meets a triangle. p = (1 - u - v) * corner 0 + u * corner 1 + v * corner 2.
struct Hit {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  float distance = std::numeric_limits<float>::infinity();
  std::uint32_t triangle = kNone;
  float u = 0.0F;
  float v = 0.0F;

  [[nodiscard]] bool is_hit() const { return triangle != kNone; }
};

/// Triangles that rays can be cast against: the one place that calls Embree. Casting is
/// thread-safe; moving points is not.
class RayScene {
 public:
  enum class Use { kFixed, kMoving };  ///< kMoving: quick to build, as every frame needs it anew

  /// Throws FatalError (kUnavailable) where Embree does not start.
  explicit RayScene(Use use);

  /// Replaces all triangles; corners count in `points`.
  void set(const std::vector<Eigen::Vector3f>& points, const std::vector<Triangle>& triangles);
  /// Moves the points of set(), as many as there were.
  void move(const std::vector<Eigen::Vector3f>& points);

  enum class Likeness {
    kAlike,
    kScattered
  };  ///< rays of neighbouring pixels, or all over the place

  /// The first hit of each ray; `hits` is as long as `rays`. Rays are cast eight at a time, which
  /// goes faster where neighbours are alike.
  void cast(std::span<const Ray> rays, std::span<Hit> hits, Likeness likeness) const;
  /// Whether anything stands in the way of each ray.
  void find_blocked(std::span<const Ray> rays, std::span<bool> blocked) const;
  [[nodiscard]] bool is_blocked(const Ray& ray) const;
  [[nodiscard]] bool is_empty() const;

  RayScene(RayScene&& other) noexcept;
  RayScene& operator=(RayScene&& other) noexcept;
  RayScene(const RayScene& other) = delete;
  RayScene& operator=(const RayScene& other) = delete;
  ~RayScene();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tsg::render
