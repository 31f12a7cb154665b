#include "common/render/stage.hpp"

#include <algorithm>
#include <array>

#include "common/core/check.hpp"
#include "common/render/parallel.hpp"
#include "common/render/sampling.hpp"

namespace tsg::render {
namespace {

constexpr float kLightGridM = 0.16F;    // light changes little within a hand's length
constexpr float kShadowReachM = 1.0F;   // farther from a body its shadow is too soft to be seen
constexpr float kContactReachM = 0.6F;  // within it a body takes bounced light away as well
constexpr int kBodyShadowSamples = 4;
constexpr int kContactRays = 12;

}  // namespace

Stage::Stage(const std::vector<Part>& fixed,
             const std::vector<Part>& bodies,
             std::vector<Lamp> lamps)
    : fixed_(make_layer(fixed, RayScene::Use::kFixed, kLightGridM)),
      bodies_(make_layer(bodies, RayScene::Use::kMoving, 0.0F)),
      lamps_(std::move(lamps)),
      baked_(bake_light(fixed_, lamps_)),
      bounced_(fixed_, baked_) {
  for (const Part& body : bodies) {
    const std::vector<float> openness =
        bake_openness(make_layer({body}, RayScene::Use::kFixed, 0.0F));
    extents_.push_back({.first = openness_.size(), .count = openness.size()});
    openness_.insert(openness_.end(), openness.begin(), openness.end());
  }
  travel_.assign(bodies_.mesh.points.size(), Eigen::Vector3f::Zero());
  body_light_.light.assign(bodies_.mesh.points.size(), Eigen::Vector3f::Zero());
  fixed_light_.light = baked_.total;
  update();
}

void Stage::pose_body(std::size_t body,
                      std::span<const Eigen::Vector3f> points,
                      std::span<const Eigen::Vector3f> normals,
                      std::span<const Eigen::Vector3f> travel) {
  const Extent& extent = extents_.at(body);
  TSG_CHECK(points.size() == extent.count && normals.size() == extent.count &&
            travel.size() == extent.count);
  const auto first = static_cast<std::ptrdiff_t>(extent.first);
  std::ranges::copy(points, bodies_.mesh.points.begin() + first);
  std::ranges::copy(normals, bodies_.mesh.normals.begin() + first);
  std::ranges::copy(travel, travel_.begin() + first);
}

void Stage::update() {
  bodies_.rays.move(bodies_.mesh.points);
  for (Extent& extent : extents_) measure(extent);
  fixed_light_.is_known.assign(fixed_.mesh.points.size(), false);
  body_light_.is_known.assign(bodies_.mesh.points.size(), false);
}

void Stage::measure(Extent& extent) const {
  if (extent.count == 0) return;
  const std::span points = std::span(bodies_.mesh.points).subspan(extent.first, extent.count);
  Eigen::Vector3f low = points.front();
  Eigen::Vector3f high = points.front();
  for (const Eigen::Vector3f& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  extent.centre = 0.5F * (low + high);
  extent.radius_m = 0.5F * (high - low).norm();
}

void Stage::look(std::span<const Ray> rays, std::span<Sighting> sightings) const {
  std::vector<Hit> hits(rays.size());
  fixed_.rays.cast(rays, hits, RayScene::Likeness::kAlike);
  for (std::size_t i = 0; i < rays.size(); ++i) sightings[i] = {hits[i], false};
  if (bodies_.rays.is_empty()) return;
  std::vector<Ray> rest(rays.begin(), rays.end());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rest[i].max_distance = std::min(rest[i].max_distance, hits[i].distance);
  }
  bodies_.rays.cast(rest, hits, RayScene::Likeness::kAlike);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].is_hit()) sightings[i] = {hits[i], true};
  }
}

void Stage::find_unknown(const Layer& layer,
                         std::span<const Sighting> seen,
                         bool of_bodies,
                         CornerLight& corners) {
  corners.unknown.clear();
  std::uint32_t last = Hit::kNone;  // neighbouring pixels mostly show the same triangle
  for (const Sighting& sighting : seen) {
    if (sighting.hit.triangle == last || sighting.is_body != of_bodies) continue;
    last = sighting.hit.triangle;
    if (last == Hit::kNone) continue;
    for (const std::uint32_t corner : layer.mesh.triangles[sighting.hit.triangle].corners) {
      if (corners.is_known[corner]) continue;
      corners.is_known[corner] = true;
      corners.unknown.push_back(corner);
    }
  }
}

void Stage::light_up(std::span<const Sighting> seen) {
  find_unknown(fixed_, seen, false, fixed_light_);
  find_unknown(bodies_, seen, true, body_light_);
  for_each_index(fixed_light_.unknown.size() + body_light_.unknown.size(),
                 [this](std::size_t i) { light_unknown(i); });
}

void Stage::light_unknown(std::size_t i) {
  const std::size_t on_fixed = fixed_light_.unknown.size();
  if (i < on_fixed) {
    const std::size_t point = fixed_light_.unknown[i];
    fixed_light_.light[point] = light_on_fixed(point);
  } else {
    const std::size_t point = body_light_.unknown[i - on_fixed];
    body_light_.light[point] = light_on_body(point);
  }
}

float Stage::distance_to_bodies(const Eigen::Vector3f& position) const {
  float nearest = std::numeric_limits<float>::infinity();
  for (const Extent& extent : extents_) {
    nearest = std::min(nearest, (extent.centre - position).norm() - extent.radius_m);
  }
  return nearest;
}

Eigen::Vector3f Stage::light_on_fixed(std::size_t index) const {
  const SurfacePoint& point = baked_.places[index];
  const float distance_m = distance_to_bodies(point.position);
  if (distance_m > kShadowReachM) return baked_.total[index];
  const auto salt = static_cast<std::uint32_t>(index);
  Eigen::Vector3f light = baked_.rest[index];
  for (const LampShare& share : baked_.strong[index]) {
    if (share.light.isZero()) continue;
    light += share.light *
             lamp_in_sight(lamps_[share.lamp], point, bodies_.rays, kBodyShadowSamples, salt);
  }
  if (distance_m > kContactReachM) return light + baked_.bounced[index];
  std::array<Ray, kContactRays> rays;
  std::array<bool, kContactRays> blocked{};
  for (int k = 0; k < kContactRays; ++k) {
    rays.at(static_cast<std::size_t>(k)) = {
        point.position + 2e-3F * point.normal,
        cosine_direction(point.normal, spread_point(k, kContactRays, salt)), kContactReachM};
  }
  bodies_.rays.find_blocked(rays, blocked);
  const auto open = std::ranges::count(blocked, false);
  return light + baked_.bounced[index] * (static_cast<float>(open) / kContactRays);
}

Eigen::Vector3f Stage::light_on_body(std::size_t index) const {
  const SurfacePoint point{bodies_.mesh.points[index], bodies_.mesh.normals[index]};
  const auto salt = static_cast<std::uint32_t>(index);
  // Weak lamps throw no shadows that one could see: openness stands for them.
  Eigen::Vector3f weak = bounced_.at(point);
  for (const Lamp& lamp : lamps_) weak += open_light(lamp, point);
  Eigen::Vector3f light = Eigen::Vector3f::Zero();
  for (const LampShare& share : strongest_lamps(lamps_, point)) {
    if (share.light.isZero()) continue;
    const Lamp& lamp = lamps_[share.lamp];
    weak -= share.light;
    light += share.light * lamp_in_sight(lamp, point, bodies_.rays, kBodyShadowSamples, salt) *
             lamp_in_sight(lamp, point, fixed_.rays, 2, salt);
  }
  return light + openness_[index] * weak.cwiseMax(0.0F);
}

Eigen::Vector3f Stage::light(const Sighting& sighting) const {
  const Triangle& triangle = layer(sighting.is_body).mesh.triangles[sighting.hit.triangle];
  return at_hit(triangle, sighting.hit, sighting.is_body ? body_light_.light : fixed_light_.light);
}

Eigen::Vector3f Stage::travel(const Sighting& sighting) const {
  if (!sighting.is_body) return Eigen::Vector3f::Zero();
  return at_hit(bodies_.mesh.triangles[sighting.hit.triangle], sighting.hit, travel_);
}

}  // namespace tsg::render
