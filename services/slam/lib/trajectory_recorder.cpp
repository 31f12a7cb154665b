#include "services/slam/lib/trajectory_recorder.hpp"

#include <algorithm>
#include <map>

namespace tsg {
namespace {

/// Null where it is not among them. `keyframes` are sorted by id.
const KeyframePose* find(const std::vector<KeyframePose>& keyframes, KeyframeId id) {
  const auto found = std::ranges::lower_bound(keyframes, id, {}, &KeyframePose::id);
  return found != keyframes.end() && found->id == id ? &*found : nullptr;
}

}  // namespace

void TrajectoryRecorder::record(const TrackResult& result) {
  if (!result.T_world_camera) {
    if (!entries_.empty()) ++lost_;
    return;
  }
  entries_.push_back({result.stamp_ns, result.part, result.reference, result.T_reference_camera,
                      *result.T_world_camera});
}

Trajectory TrajectoryRecorder::live(MapPart part) const {
  Trajectory poses;
  poses.reserve(entries_.size());
  for (const Entry& entry : entries_) {
    if (entry.part == part) poses.push_back({entry.stamp_ns, entry.T_world_camera});
  }
  return poses;
}

MapPart TrajectoryRecorder::longest_part(const std::vector<KeyframePose>& keyframes) const {
  std::map<MapPart, std::size_t> frames;
  for (const Entry& entry : entries_) {
    const KeyframePose* keyframe = find(keyframes, entry.reference);
    if (keyframe != nullptr) ++frames[keyframe->part];
  }
  if (frames.empty()) return 0;
  return std::ranges::max_element(frames, {}, [](const auto& part) { return part.second; })->first;
}

Trajectory TrajectoryRecorder::corrected(const std::vector<KeyframePose>& keyframes) const {
  const MapPart part = longest_part(keyframes);
  Trajectory poses;
  poses.reserve(entries_.size());
  for (const Entry& entry : entries_) {
    const KeyframePose* keyframe = find(keyframes, entry.reference);
    if (keyframe == nullptr || keyframe->part != part) continue;
    poses.push_back({entry.stamp_ns, keyframe->T_world_camera * entry.T_reference_camera});
  }
  return poses;
}

}  // namespace tsg
