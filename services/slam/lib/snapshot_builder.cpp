#include "services/slam/lib/snapshot_builder.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace tsg {
namespace {

constexpr double kMetresPerRadian = 2.0;  // a turn by one radian changes the view like such a move

double view_distance(const Keyframe& a, const Keyframe& b) {
  const SE3 T_a_b = a.T_world_camera.inverse() * b.T_world_camera;
  return T_a_b.translation().norm() + kMetresPerRadian * T_a_b.angle();
}

/// All keyframes, the most useful first.
std::vector<KeyframeId> by_usefulness(const Map& map,
                                      const MapperConfig& config,
                                      KeyframeId newest) {
  const Keyframe& centre = map.keyframe(newest);
  std::vector<KeyframeId> order = {newest};
  std::unordered_set<KeyframeId> known = {newest};
  for (const Covisibility& neighbour : map.covisible_with(centre)) {
    if (neighbour.shared < config.min_shared_points) break;
    order.push_back(neighbour.keyframe);
    known.insert(neighbour.keyframe);
  }
  std::vector<std::pair<double, KeyframeId>> others;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (known.contains(id) || keyframe.part != centre.part) continue;
    others.emplace_back(view_distance(centre, keyframe), id);
  }
  std::sort(others.begin(), others.end());
  for (const auto& [distance, id] : others) order.push_back(id);
  return order;
}

SnapshotPoint to_snapshot(const MapPoint& point) {
  return {.id = point.id,
          .position = point.position,
          .normal = point.normal.cast<float>(),
          .min_distance = static_cast<float>(point.min_distance),
          .max_distance = static_cast<float>(point.max_distance),
          .observations = static_cast<int>(point.observations.size()),
          .descriptor = point.descriptor};
}

/// `recalled`, then in turn a neighbour of each.
std::vector<KeyframeId> around(const Map& map, const std::vector<KeyframeId>& recalled) {
  std::vector<KeyframeId> order = recalled;
  std::unordered_set<KeyframeId> known(recalled.begin(), recalled.end());
  std::vector<std::vector<Covisibility>> neighbours;
  std::size_t most = 0;
  for (const KeyframeId id : recalled) {
    neighbours.push_back(map.covisible_with(map.keyframe(id)));
    most = std::max(most, neighbours.back().size());
  }
  const auto add = [&](const std::vector<Covisibility>& of_one, std::size_t i) {
    if (i < of_one.size() && known.insert(of_one[i].keyframe).second) {
      order.push_back(of_one[i].keyframe);
    }
  };
  for (std::size_t i = 0; i < most; ++i) {
    for (const auto& of_one : neighbours) add(of_one, i);
  }
  return order;
}

LocalMapSnapshot copy_keyframes(const Map& map,
                                const MapperConfig& config,
                                KeyframeId newest,
                                const std::vector<KeyframeId>& order) {
  LocalMapSnapshot snapshot;
  snapshot.newest = newest;
  snapshot.part = map.keyframe(order.front()).part;
  snapshot.map_keyframes = map.keyframes().size();
  snapshot.map_points = map.point_count();
  std::unordered_set<PointId> known;
  for (const KeyframeId id : order) {
    if (static_cast<int>(snapshot.keyframes.size()) >= config.snapshot_keyframes) break;
    if (static_cast<int>(snapshot.points.size()) >= config.snapshot_points) break;
    const Keyframe& keyframe = map.keyframe(id);
    snapshot.keyframes.push_back(
        {keyframe.id, keyframe.T_world_camera, keyframe.features, keyframe.points});
    for (const PointId point : keyframe.points) {
      if (point == kNoPoint || !known.insert(point).second) continue;
      snapshot.points.push_back(to_snapshot(*map.find_point(point)));
    }
  }
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  std::sort(snapshot.points.begin(), snapshot.points.end(), by_id);
  std::sort(snapshot.keyframes.begin(), snapshot.keyframes.end(), by_id);
  return snapshot;
}

}  // namespace

LocalMapSnapshot build_snapshot(const Map& map, const MapperConfig& config, KeyframeId newest) {
  return copy_keyframes(map, config, newest, by_usefulness(map, config, newest));
}

LocalMapSnapshot build_recall_snapshot(const Map& map,
                                       const MapperConfig& config,
                                       KeyframeId newest,
                                       const std::vector<KeyframeId>& recalled) {
  LocalMapSnapshot snapshot = copy_keyframes(map, config, newest, around(map, recalled));
  snapshot.recalled = recalled;
  return snapshot;
}

}  // namespace tsg
