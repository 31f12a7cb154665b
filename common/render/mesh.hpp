#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/geometry/se3.hpp"
#include "common/render/texture.hpp"

namespace tsg::render {

/// What a surface looks like, to the eye and to a depth sensor.
struct Material {
  Eigen::Vector3f colour_bgr = Eigen::Vector3f::Ones();  ///< linear light, 0..1; times the texture
  std::shared_ptr<const Texture> texture{};              ///< null: plain colour
  float texture_repeats = 1.0F;                          ///< textures per unit of uv
  float emission = 0.0F;      ///< light of its own; 1 = as bright as a well-lit white wall
  float gloss = 0.0F;         ///< strength of the highlight of lamps, 0..1
  bool returns_depth = true;  ///< false: glass, dark screens: an infrared sensor sees nothing there
};

struct Triangle {
  std::array<std::uint32_t, 3> corners{};  ///< counter-clockwise seen from outside
  std::uint32_t material = 0;
};

/// Triangles with their own axes. `points` (metres), `normals` (unit) and `uvs` are of one length.
struct Mesh {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Eigen::Vector2f> uvs;
  std::vector<Triangle> triangles;
  std::vector<Material> materials;

  /// Adds all of `other`, moved into this mesh's axes.
  void append(const Mesh& other, const SE3& T_this_other = {});
};

/// Splits triangles until no edge is longer than `max_edge_m`, so that light, which is computed at
/// corners, can change across big faces. Neighbours stay joined.
[[nodiscard]] Mesh subdivided(const Mesh& mesh, float max_edge_m);

}  // namespace tsg::render
