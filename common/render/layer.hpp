#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/render/mesh.hpp"
#include "common/render/ray_scene.hpp"

namespace tsg::render {

/// A mesh and who it belongs to, e.g. one chair.
struct Part {
  Mesh mesh;
  std::uint16_t tag = 0;
};

/// Many parts in world axes, ready for rays.
struct Layer {
  explicit Layer(RayScene::Use use) : rays(use) {}

  Mesh mesh;
  RayScene rays;
  std::vector<std::uint16_t> tags;          ///< of each triangle
  std::vector<float> texture_density;       ///< of each triangle: textures per metre
  std::vector<Eigen::Vector3f> reflection;  ///< of each material: mean share of light given back
};

/// Joins the parts; faces are split to edges of at most `max_edge_m` (0: left as they are).
[[nodiscard]] Layer make_layer(const std::vector<Part>& parts, RayScene::Use use, float max_edge_m);

/// The value at a hit of what is known at the corners.
template <typename T>
[[nodiscard]] T at_hit(const Triangle& triangle, const Hit& hit, const std::vector<T>& values) {
  const auto& [a, b, c] = triangle.corners;
  return (1.0F - hit.u - hit.v) * values[a] + hit.u * values[b] + hit.v * values[c];
}

/// What the surface throws back at a hit of the `light` that falls on the corners.
[[nodiscard]] Eigen::Vector3f thrown_back(const Layer& layer,
                                          const Hit& hit,
                                          const std::vector<Eigen::Vector3f>& light);

}  // namespace tsg::render
