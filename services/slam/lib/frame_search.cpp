#include "services/slam/lib/frame_search.hpp"

#include <algorithm>
#include <optional>
#include <unordered_set>

#include "services/slam/lib/feature_matcher.hpp"
#include "services/slam/lib/nearest_depth.hpp"
#include "services/slam/lib/point_projection.hpp"

namespace tsg {
namespace {

constexpr float kMovedDepthError = 0.1F;  // 1/m: the prediction may be off by 10 cm at 1 m
constexpr double kMapDepthSigmas = 12.0;  // of inverse depth: the pose is nearly right
constexpr MatchLimits kLastFrameLimits{.max_distance = 80, .max_ratio = 0.95F};
constexpr MatchLimits kLocalMapLimits{.max_distance = 80, .max_ratio = 0.85F};
constexpr MatchLimits kKeyframeLimits{.max_distance = 70, .max_ratio = 0.9F};

struct LastPoint {
  int feature = 0;
  PointId id = kNoPoint;
  Eigen::Vector3d p_world;
};

/// Where feature `i` of `last` lies in the world: by the map, else by its depth if that is asked
/// for.
std::optional<LastPoint> locate(const ObservationModel& model,
                                const LocalMapSnapshot& map,
                                const TrackedFrame& last,
                                std::size_t i,
                                LastFramePoints which) {
  const SnapshotPoint* point =
      last.points[i] == kNoPoint ? nullptr : map.find_point(last.points[i]);
  const int feature = static_cast<int>(i);
  if (point != nullptr) return LastPoint{feature, point->id, point->position};
  const Feature& item = last.features->items[i];
  if (which == LastFramePoints::kMapped || !item.has_depth()) return std::nullopt;
  const bool is_doubtful = !last.doubtful.empty() && last.doubtful[i];
  if (which == LastFramePoints::kSeenToStay && is_doubtful) return std::nullopt;
  const Eigen::Vector3d p_camera =
      model.camera().unproject(item.pixel.cast<double>(), 1.0 / item.inverse_depth);
  return LastPoint{feature, kNoPoint, last.T_world_camera * p_camera};
}

std::optional<MatchTarget> expect(const ObservationModel& model,
                                  const TrackedFrame& last,
                                  const LastPoint& point,
                                  const SE3& T_camera_world,
                                  double radius_px) {
  const Eigen::Vector3d p_camera = T_camera_world * point.p_world;
  if (p_camera.z() < kMinDepth) return std::nullopt;
  const Eigen::Vector2d pixel = model.camera().project(p_camera);
  if (!model.camera().contains(pixel)) return std::nullopt;
  const auto i = static_cast<std::size_t>(point.feature);
  const Feature& feature = last.features->items[i];
  return MatchTarget{.pixel = pixel.cast<float>(),
                     .radius = static_cast<float>(radius_px * model.level_scale(feature.level)),
                     .inverse_depth = static_cast<float>(1.0 / p_camera.z()),
                     .max_depth_error = kMovedDepthError,
                     .min_level = std::max(0, feature.level - 1),
                     .max_level = feature.level + 1,
                     .angle = feature.angle,
                     .descriptor = &last.features->descriptors[i]};
}

/// The features, by flag, that are more likely to move than `most`.
std::vector<bool> beyond(const Features& features, FeatureVerdict most) {
  if (most == FeatureVerdict::kDynamic) return {};
  std::vector<bool> flags(features.size());
  std::transform(features.items.begin(), features.items.end(), flags.begin(),
                 [most](const Feature& feature) { return feature.verdict > most; });
  return flags;
}

}  // namespace

FrameMatches FrameSearch::match_last_frame(const TrackedFrame& last,
                                           LastFramePoints which,
                                           const SE3& T_camera_world,
                                           double radius_px) const {
  const FeatureVerdict most =
      classes_ == MatchedClasses::kStatic ? FeatureVerdict::kStatic : FeatureVerdict::kDynamic;
  std::vector<LastPoint> points;
  std::vector<MatchTarget> targets;
  for (std::size_t i = 0; i < last.points.size(); ++i) {
    if (last.features->items[i].verdict > most) continue;
    const auto point = locate(model_, map_, last, i, which);
    if (!point) continue;
    auto target = expect(model_, last, *point, T_camera_world, radius_px);
    if (!target) continue;
    target->source = static_cast<int>(points.size());
    points.push_back(*point);
    targets.push_back(*target);
  }
  auto found = match_by_projection(features_, targets, beyond(features_, most), kLastFrameLimits);
  keep_consistent_rotations(found);
  FrameMatches matches(features_);
  for (const FeatureMatch& match : found) {
    const LastPoint& point = points[static_cast<std::size_t>(match.source)];
    matches.assign(match.feature, point.id, point.p_world);
  }
  return matches;
}

FrameMatches FrameSearch::match_keyframe(const SnapshotKeyframe& keyframe) const {
  std::vector<bool> usable(keyframe.points.size());
  for (std::size_t i = 0; i < usable.size(); ++i) {
    usable[i] = keyframe.points[i] != kNoPoint && map_.find_point(keyframe.points[i]) != nullptr;
  }
  auto found = match_by_descriptor(*keyframe.features, usable, features_, kKeyframeLimits);
  keep_consistent_rotations(found);
  FrameMatches matches(features_);
  for (const FeatureMatch& match : found) {
    const PointId id = keyframe.points[static_cast<std::size_t>(match.source)];
    matches.assign(match.feature, id, map_.find_point(id)->position);
  }
  return matches;
}

std::vector<PointId> FrameSearch::match_local_map(const SE3& T_camera_world,
                                                  double radius_px,
                                                  FrameMatches& matches) const {
  const std::vector<PointId> before = matches.points();
  const std::unordered_set<PointId> known(before.begin(), before.end());
  const ProjectionSearch search{
      .T_camera_world = T_camera_world, .radius = radius_px, .depth_gate_sigmas = kMapDepthSigmas};
  std::vector<PointId> in_view;
  std::vector<MatchTarget> targets;
  for (std::size_t i = 0; i < map_.points.size(); ++i) {
    const SnapshotPoint& point = map_.points[i];
    const PointAppearance appearance{.position = point.position,
                                     .normal = point.normal.cast<double>(),
                                     .min_distance = point.min_distance,
                                     .max_distance = point.max_distance,
                                     .descriptor = &point.descriptor};
    auto target = project_point(model_, search, appearance);
    if (!target) continue;
    in_view.push_back(point.id);
    if (known.contains(point.id)) continue;
    target->source = static_cast<int>(i);
    targets.push_back(*target);
  }
  for (const FeatureMatch& match :
       match_by_projection(features_, targets, matches.taken(), kLocalMapLimits)) {
    const SnapshotPoint& point = map_.points[static_cast<std::size_t>(match.source)];
    matches.assign(match.feature, point.id, point.position);
  }
  return in_view;
}

}  // namespace tsg
