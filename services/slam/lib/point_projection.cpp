#include "services/slam/lib/point_projection.hpp"

#include <algorithm>

#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr double kRangeMargin = 1.2;    // one level of scale beyond what was seen
constexpr double kMinViewCosine = 0.5;  // 60 degrees: further round a patch looks different

}  // namespace

PointAppearance appearance_of(const MapPoint& point) {
  return {.position = point.position,
          .normal = point.normal,
          .min_distance = point.min_distance,
          .max_distance = point.max_distance,
          .descriptor = &point.descriptor};
}

std::optional<MatchTarget> project_point(const ObservationModel& model,
                                         const ProjectionSearch& search,
                                         const PointAppearance& point) {
  const Eigen::Vector3d p_camera = search.T_camera_world * point.position;
  if (p_camera.z() < kMinDepth) return std::nullopt;
  const Eigen::Vector2d pixel = model.camera().project(p_camera);
  if (!model.camera().contains(pixel)) return std::nullopt;
  const double distance = p_camera.norm();
  if (distance > point.max_distance * kRangeMargin ||
      distance < point.min_distance / kRangeMargin) {
    return std::nullopt;
  }
  const Eigen::Vector3d normal_camera = search.T_camera_world.rotation() * point.normal;
  if (-p_camera.dot(normal_camera) < kMinViewCosine * distance) return std::nullopt;
  const int level = model.level_at(point.max_distance, distance);
  MatchTarget target;
  target.pixel = pixel.cast<float>();
  target.radius = static_cast<float>(search.radius * model.level_scale(level));
  target.inverse_depth = static_cast<float>(1.0 / p_camera.z());
  target.max_depth_error =
      static_cast<float>(search.depth_gate_sigmas * model.inverse_depth_sigma());
  target.min_level = std::max(0, level - 1);
  target.max_level = std::min(model.levels() - 1, level + 1);
  target.descriptor = point.descriptor;
  return target;
}

}  // namespace tsg
