#include "services/slam/lib/map_motion.hpp"

#include <unordered_set>

#include "common/core/check.hpp"

namespace tsg {
namespace {

/// How the world around each keyframe moves.
std::map<KeyframeId, SE3> motions(const Map& map, const KeyframeTargets& targets) {
  TSG_CHECK(!targets.empty());
  std::map<KeyframeId, SE3> T_moved_world;
  std::map<MapPart, SE3> last;
  for (const auto& [id, keyframe] : map.keyframes()) {
    const auto target = targets.find(id);
    if (target != targets.end()) {
      last[keyframe.part] = target->second * keyframe.T_world_camera.inverse();
    }
    T_moved_world[id] = last[keyframe.part];
  }
  return T_moved_world;
}

const SE3& motion_of(const MapPoint& point, const std::map<KeyframeId, SE3>& T_moved_world) {
  const auto maker = T_moved_world.find(point.created_in);
  return maker != T_moved_world.end() ? maker->second
                                      : T_moved_world.at(point.observations.front().keyframe);
}

}  // namespace

void move_map(Map& map, const ObservationModel& model, const KeyframeTargets& targets) {
  const auto T_moved_world = motions(map, targets);
  std::vector<PointId> points;
  std::unordered_set<PointId> known;
  for (const auto& [id, T_moved] : T_moved_world) {
    Keyframe& keyframe = *map.find_keyframe(id);
    keyframe.T_world_camera = T_moved * keyframe.T_world_camera;
    for (const PointId point : keyframe.points) {
      if (point != kNoPoint && known.insert(point).second) points.push_back(point);
    }
  }
  for (const PointId id : points) {
    MapPoint& point = *map.find_point(id);
    point.position = motion_of(point, T_moved_world) * point.position;
  }
  for (const PointId id : points) map.update_appearance(*map.find_point(id), model);
}

}  // namespace tsg
