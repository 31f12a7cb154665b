#include "common/render/layer.hpp"

#include <cmath>

namespace tsg::render {
namespace {

/// Textures per metre on a triangle: what a mip level is chosen by.
float density_of(const Mesh& mesh, const Triangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const float area =
      (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
  const Eigen::Vector2f u = mesh.uvs[b] - mesh.uvs[a];
  const Eigen::Vector2f v = mesh.uvs[c] - mesh.uvs[a];
  const float uv_area = std::abs(u.x() * v.y() - u.y() * v.x());
  if (area <= 0.0F) return 0.0F;
  return std::sqrt(uv_area / area) * mesh.materials[triangle.material].texture_repeats;
}

Eigen::Vector3f reflection_of(const Material& material) {
  if (!material.texture) return material.colour_bgr;
  constexpr float kWholeTexture = 1.0F;
  return material.colour_bgr.cwiseProduct(
      material.texture->sample(Eigen::Vector2f(0.5F, 0.5F), kWholeTexture));
}

}  // namespace

Layer make_layer(const std::vector<Part>& parts, RayScene::Use use, float max_edge_m) {
  Layer layer(use);
  for (const Part& part : parts) {
    layer.mesh.append(max_edge_m > 0.0F ? subdivided(part.mesh, max_edge_m) : part.mesh);
    layer.tags.resize(layer.mesh.triangles.size(), part.tag);
  }
  for (const Triangle& triangle : layer.mesh.triangles) {
    layer.texture_density.push_back(density_of(layer.mesh, triangle));
  }
  for (const Material& material : layer.mesh.materials) {
    layer.reflection.push_back(reflection_of(material));
  }
  layer.rays.set(layer.mesh.points, layer.mesh.triangles);
  return layer;
}

Eigen::Vector3f thrown_back(const Layer& layer,
                            const Hit& hit,
                            const std::vector<Eigen::Vector3f>& light) {
  const Triangle& triangle = layer.mesh.triangles[hit.triangle];
  return at_hit(triangle, hit, light).cwiseProduct(layer.reflection[triangle.material]);
}

}  // namespace tsg::render
