#include "common/render/surface_light.hpp"

#include <algorithm>
#include <cmath>

namespace tsg::render {
namespace {

constexpr float kHighlightBlur =
    0.12F;                            // of the distance to the lamp: how rough glossy surfaces are
constexpr float kFarMiss = 9.0F;      // squared, in blurs: what is left is below one part in 8000
constexpr float kLeastFacing = 0.2F;  // flatter views blur no further, or floors lose all texture

/// How strongly a mirrored line of sight hits a lamp: 1 inside, falling off around it.
float hit_strength(const Lamp& lamp,
                   const Eigen::Vector3f& from,
                   const Eigen::Vector3f& direction) {
  const float towards = -lamp.normal.dot(direction);
  if (towards <= 1e-3F) return 0.0F;
  const float distance = lamp.normal.dot(from - lamp.centre_m) / towards;
  if (distance <= 0.0F) return 0.0F;
  const Eigen::Vector3f offset = from + distance * direction - lamp.centre_m;
  const auto beyond = [&](const Eigen::Vector3f& half_side) {
    const float half = half_side.norm();
    return std::max(0.0F, std::abs(offset.dot(half_side)) / half - half);
  };
  const float beyond_a = beyond(lamp.half_side_a_m);
  const float beyond_b = beyond(lamp.half_side_b_m);
  const float blur_m = kHighlightBlur * distance;
  const float squared_miss = (beyond_a * beyond_a + beyond_b * beyond_b) / (blur_m * blur_m);
  return squared_miss > kFarMiss ? 0.0F : std::exp(-squared_miss);
}

Eigen::Vector3f highlight(const Stage& stage,
                          const Eigen::Vector3f& position,
                          const Eigen::Vector3f& mirrored) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Lamp& lamp : stage.lamps()) {
    sum += hit_strength(lamp, position, mirrored) * lamp.radiance_bgr;
  }
  return sum;
}

}  // namespace

Eigen::Vector3f normal_at(const Stage& stage, const Sighting& sighting, const Ray& ray) {
  const Mesh& mesh = stage.layer(sighting.is_body).mesh;
  const Eigen::Vector3f normal =
      at_hit(mesh.triangles[sighting.hit.triangle], sighting.hit, mesh.normals).normalized();
  return normal.dot(ray.direction) > 0.0F ? Eigen::Vector3f(-normal) : normal;
}

Eigen::Vector3f radiance_towards(const Stage& stage,
                                 const Sighting& sighting,
                                 const Ray& ray,
                                 const Eigen::Vector3f& normal,
                                 float pixel_angle) {
  const Layer& layer = stage.layer(sighting.is_body);
  const Triangle& triangle = layer.mesh.triangles[sighting.hit.triangle];
  const Material& material = layer.mesh.materials[triangle.material];
  const Eigen::Vector3f sight = ray.direction.normalized();
  Eigen::Vector3f colour = material.colour_bgr;
  if (material.texture) {
    const Eigen::Vector2f uv =
        at_hit(triangle, sighting.hit, layer.mesh.uvs) * material.texture_repeats;
    const float distance_m = sighting.hit.distance * ray.direction.norm();
    const float facing = std::max(-normal.dot(sight), kLeastFacing);
    const float footprint =
        layer.texture_density[sighting.hit.triangle] * distance_m * pixel_angle / std::sqrt(facing);
    colour = colour.cwiseProduct(material.texture->sample(uv, footprint));
  }
  Eigen::Vector3f radiance =
      colour.cwiseProduct(stage.light(sighting)) + material.emission * colour;
  if (material.gloss > 0.0F) {
    const Eigen::Vector3f position = ray.origin + sighting.hit.distance * ray.direction;
    const Eigen::Vector3f mirrored = sight - 2.0F * normal.dot(sight) * normal;
    // Schlick's approximation: all surfaces mirror more when seen flat.
    const float flat = std::max(1.0F + normal.dot(sight), 0.0F);
    radiance += material.gloss * (0.04F + 0.96F * flat * flat * flat * flat * flat) *
                highlight(stage, position, mirrored);
  }
  return radiance;
}

}  // namespace tsg::render
