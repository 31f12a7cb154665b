#include "services/slam/lib/point_fusion.hpp"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "services/slam/lib/feature_matcher.hpp"
#include "services/slam/lib/point_projection.hpp"

namespace tsg {
namespace {

constexpr double kSearchRadius = 3.0;      // pixels of the level: both poses are known well
constexpr double kFusionGateSigmas = 8.0;  // of inverse depth: two measurements and the pose
constexpr int kMaxFusionDistance = 50;     // of descriptors: merging wrongly hurts for good

/// Joins point `id` with what `feature` of `keyframe` shows.
void join(Map& map, PointId id, Keyframe& keyframe, int feature) {
  const PointId shown = keyframe.points[static_cast<std::size_t>(feature)];
  MapPoint& point = *map.find_point(id);
  if (shown == kNoPoint) {
    Map::add_observation(point, keyframe, feature);
    return;
  }
  if (shown == id) return;
  const bool keep_shown = map.find_point(shown)->observations.size() >= point.observations.size();
  map.merge_points(keep_shown ? id : shown, keep_shown ? shown : id);
}

std::vector<PointId> points_of(const Keyframe& keyframe) {
  std::vector<PointId> points = keyframe.points;
  std::erase(points, kNoPoint);
  return points;
}

}  // namespace

void fuse_points_into(Map& map,
                      const ObservationModel& model,
                      const std::vector<PointId>& points,
                      KeyframeId keyframe_id,
                      double radius) {
  Keyframe& keyframe = *map.find_keyframe(keyframe_id);
  const ProjectionSearch search{.T_camera_world = keyframe.T_world_camera.inverse(),
                                .radius = radius,
                                .depth_gate_sigmas = kFusionGateSigmas};
  std::vector<MatchTarget> targets;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const MapPoint* point = map.find_point(points[i]);
    if (point == nullptr) continue;
    const bool seen = std::any_of(point->observations.begin(), point->observations.end(),
                                  [&](const Observation& o) { return o.keyframe == keyframe_id; });
    if (seen) continue;
    if (auto target = project_point(model, search, appearance_of(*point))) {
      target->source = static_cast<int>(i);
      targets.push_back(*target);
    }
  }
  const auto matches = match_by_projection(*keyframe.features, targets, {},
                                           {.max_distance = kMaxFusionDistance, .max_ratio = 1.0F});
  for (const FeatureMatch& match : matches) {
    const PointId id = points[static_cast<std::size_t>(match.source)];
    // A merge before may have taken this point.
    if (map.find_point(id) != nullptr) join(map, id, keyframe, match.feature);
  }
}

void fuse_with_neighbours(Map& map,
                          const ObservationModel& model,
                          const MapperConfig& config,
                          KeyframeId newest) {
  std::vector<KeyframeId> neighbours;
  for (const Covisibility& neighbour : map.covisible_with(map.keyframe(newest))) {
    if (neighbour.shared < config.min_shared_points) break;
    if (static_cast<int>(neighbours.size()) >= config.window_keyframes) break;
    neighbours.push_back(neighbour.keyframe);
  }
  for (const KeyframeId neighbour : neighbours) {
    fuse_points_into(map, model, points_of(map.keyframe(newest)), neighbour, kSearchRadius);
  }
  std::vector<PointId> theirs;
  std::unordered_set<PointId> known;
  for (const KeyframeId neighbour : neighbours) {
    for (const PointId id : points_of(map.keyframe(neighbour))) {
      if (known.insert(id).second) theirs.push_back(id);
    }
  }
  fuse_points_into(map, model, theirs, newest, kSearchRadius);
  for (const PointId id : points_of(map.keyframe(newest))) {
    map.update_appearance(*map.find_point(id), model);
  }
}

}  // namespace tsg
