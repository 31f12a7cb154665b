#include "services/slam/results.hpp"

#include "common/core/atomic_file.hpp"
#include "common/dataset/trajectory.hpp"
#include "services/slam/odometry.hpp"

namespace tsg {
namespace {

Trajectory in_map(Trajectory trajectory) {
  for (StampedPose& pose : trajectory) {
    pose.T_world_camera = Odometry::T_map_world() * pose.T_world_camera;
  }
  return trajectory;
}

Trajectory to_trajectory(const std::vector<KeyframePose>& keyframes,
                         KeyframeId first,
                         MapPart part) {
  Trajectory trajectory;
  trajectory.reserve(keyframes.size());
  for (const KeyframePose& keyframe : keyframes) {
    if (keyframe.id < first || keyframe.part != part) continue;
    trajectory.push_back({keyframe.stamp_ns, keyframe.T_world_camera});
  }
  return trajectory;
}

}  // namespace

Expected<void> save_results(const std::filesystem::path& folder,
                            const TrajectoryRecorder& recorder,
                            const std::vector<KeyframePose>& keyframes,
                            KeyframeId first_of_session) {
  const auto write = [&](const char* name, Trajectory trajectory) {
    return write_trajectory(folder / name, in_map(std::move(trajectory)),
                            StampDecimals::kNanoseconds);
  };
  const MapPart part = recorder.longest_part(keyframes);
  return make_folder(folder)
      .and_then([&] { return write("trajectory.txt", recorder.corrected(keyframes)); })
      .and_then([&] { return write("trajectory_live.txt", recorder.live(part)); })
      .and_then(
          [&] { return write("keyframes.txt", to_trajectory(keyframes, first_of_session, part)); });
}

}  // namespace tsg
