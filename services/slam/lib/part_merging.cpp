#include "services/slam/lib/part_merging.hpp"

#include "services/slam/lib/map_motion.hpp"

namespace tsg {

void merge_part(
    Map& map, const ObservationModel& model, MapPart from, MapPart into, const SE3& T_into_from) {
  KeyframeTargets targets;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (keyframe.part == from) targets[id] = T_into_from * keyframe.T_world_camera;
  }
  move_map(map, model, targets);
  for (const auto& [id, target] : targets) map.find_keyframe(id)->part = into;
}

void merge_parts_of(Map& map, const ObservationModel& model, const Loop& loop, MapPart main_part) {
  const MapPart before = map.keyframe(loop.seen_before).part;
  const Keyframe& newest = map.keyframe(loop.newest);
  if (newest.part == before) return;
  const SE3 T_before_new = loop.T_world_newest * newest.T_world_camera.inverse();
  const bool old_one_stays =
      before == main_part || (newest.part != main_part && before < newest.part);
  if (old_one_stays) {
    merge_part(map, model, newest.part, before, T_before_new);
  } else {
    merge_part(map, model, before, newest.part, T_before_new.inverse());
  }
}

}  // namespace tsg
