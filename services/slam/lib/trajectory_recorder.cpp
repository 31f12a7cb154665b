#include "services/slam/lib/trajectory_recorder.hpp"

#include <algorithm>

namespace tsg {

void TrajectoryRecorder::record(const TrackResult& result) {
  if (!result.T_world_camera) {
    if (!entries_.empty()) ++lost_;
    return;
  }
  entries_.push_back(
      {result.stamp_ns, result.reference, result.T_reference_camera, *result.T_world_camera});
}

Trajectory TrajectoryRecorder::live() const {
  Trajectory poses;
  poses.reserve(entries_.size());
  for (const Entry& entry : entries_) poses.push_back({entry.stamp_ns, entry.T_world_camera});
  return poses;
}

Trajectory TrajectoryRecorder::corrected(const std::vector<KeyframePose>& keyframes) const {
  Trajectory poses;
  poses.reserve(entries_.size());
  for (const Entry& entry : entries_) {
    const auto keyframe =
        std::lower_bound(keyframes.begin(), keyframes.end(), entry.reference,
                         [](const KeyframePose& pose, KeyframeId id) { return pose.id < id; });
    if (keyframe == keyframes.end() || keyframe->id != entry.reference) continue;
    poses.push_back({entry.stamp_ns, keyframe->T_world_camera * entry.T_reference_camera});
  }
  return poses;
}

}  // namespace tsg
