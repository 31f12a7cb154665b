#include "services/tsgctl/map_eval/map_sequence.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "common/dataset/association.hpp"
#include "common/dataset/evaluation.hpp"
#include "common/dataset/trajectory.hpp"
#include "services/slam/offline/offline_slam.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

constexpr double kSameInstance = 0.5;  // intersection over union of two boxes of one thing

double overlap(const cv::Rect2f& a, const cv::Rect2f& b) {
  const double common = (a & b).area();
  const double all = a.area() + b.area() - common;
  return all > 0.0 ? common / all : 0.0;
}

MotionVerdict verdict_on(const Instance& instance, const FrameVerdicts& verdicts) {
  const InstanceState* best = nullptr;
  double best_overlap = kSameInstance;
  for (const InstanceState& state : verdicts.instances) {
    if (state.class_name != instance.class_name) continue;
    const double shared = overlap(instance.box, cv::Rect2f(state.box));
    if (shared < best_overlap) continue;
    best = &state;
    best_overlap = shared;
  }
  if (best == nullptr) return MotionVerdict::kUnknown;
  return best->is_moving ? MotionVerdict::kMoving : MotionVerdict::kStatic;
}

InstanceTruth open_masks(const fs::path& folder) {
  auto truth = InstanceTruth::open(folder);
  if (truth) return std::move(*truth);
  if (truth.error().code != ExitCode::kMissingInput) throw FatalError(truth.error());
  throw FatalError(ExitCode::kMissingInput,
                   "nothing tells which pixels are people: " + truth.error().message +
                       "; 'tsgctl simulate SCENE --out DIR' makes one");
}

bool has_truth(const fs::path& folder) { return fs::exists(folder / "groundtruth.txt"); }

/// The same trajectory in the world of the truth, where there is one.
Trajectory in_true_world(Trajectory trajectory, const fs::path& folder) {
  if (!has_truth(folder)) return trajectory;
  const Trajectory truth = value_or_throw(read_ground_truth(folder));
  const SE3 T_world_estimate = value_or_throw(absolute_error(truth, trajectory)).T_world_estimate;
  for (StampedPose& pose : trajectory) pose.T_world_camera = T_world_estimate * pose.T_world_camera;
  return trajectory;
}

/// The pose of each frame that has one, by index.
std::map<std::size_t, SE3> poses_of_frames(const TumFolder& folder, const Trajectory& trajectory) {
  std::vector<std::int64_t> frames;
  std::vector<std::int64_t> poses;
  for (const RgbdFiles& frame : folder.frames) frames.push_back(frame.stamp_ns);
  for (const StampedPose& pose : trajectory) poses.push_back(pose.stamp_ns);
  std::map<std::size_t, SE3> found;
  for (const StampPair& pair : associate(frames, poses, kDefaultMaxDifferenceNs)) {
    found[pair.first] = trajectory[pair.second].T_world_camera;
  }
  return found;
}

PlannedKeyframe with_true_mask(const TumFolder& folder,
                               const InstanceTruth& masks,
                               std::size_t frame,
                               const SE3& T_world_camera) {
  TrueMask mask = value_or_throw(masks.mask_at(folder.frames[frame].stamp_ns));
  return {.frame = frame,
          .T_world_camera = T_world_camera,
          .instances = std::move(mask.segmentation),
          .ids = std::move(mask.ids)};
}

std::vector<PlannedKeyframe> every_so_many(const MapSequenceOptions& options,
                                           const TumFolder& folder,
                                           const InstanceTruth& masks) {
  const bool use_truth = options.poses == PoseSource::kTruth;
  const Trajectory trajectory =
      use_truth
          ? value_or_throw(read_ground_truth(options.folder))
          : in_true_world(value_or_throw(read_trajectory(options.trajectory)), options.folder);
  std::vector<PlannedKeyframe> keyframes;
  for (const auto& [frame, T_world_camera] : poses_of_frames(folder, trajectory)) {
    if (frame % options.every_frames != 0) continue;
    keyframes.push_back(with_true_mask(folder, masks, frame, T_world_camera));
  }
  return keyframes;
}

std::vector<PlannedKeyframe> chosen_by_slam(
    const MapSequenceOptions& options,
    const TumFolder& folder,
    const InstanceTruth& masks,
    const std::function<void(std::size_t done, std::size_t total)>& on_frame) {
  std::map<std::size_t, std::shared_ptr<const FrameVerdicts>> chosen;
  std::size_t done = 0;
  const OfflineHooks hooks{.now_ns = {}, .on_frame = [&](const OfflineFrame& frame) {
                             if (frame.is_keyframe) chosen[frame.seq] = frame.verdicts;
                             on_frame(++done, folder.frames.size());
                           }};
  const OfflineRun run =
      value_or_throw(run_offline(folder, OfflineOptions{.slam = options.slam}, hooks));
  const auto poses = poses_of_frames(folder, in_true_world(run.corrected, options.folder));
  std::vector<PlannedKeyframe> keyframes;
  for (const auto& [frame, verdicts] : chosen) {
    const auto pose = poses.find(frame);
    if (pose == poses.end()) continue;  // in a part of the map that was never joined with the rest
    keyframes.push_back(with_true_mask(folder, masks, frame, pose->second));
    keyframes.back().instances = with_verdicts(std::move(keyframes.back().instances), *verdicts);
  }
  return keyframes;
}

}  // namespace

InstanceSegmentation with_verdicts(InstanceSegmentation mask, const FrameVerdicts& verdicts) {
  for (Instance& instance : mask.instances) instance.motion = verdict_on(instance, verdicts);
  return mask;
}

MapSequence plan_keyframes(
    const MapSequenceOptions& options,
    const std::function<void(std::size_t done, std::size_t total)>& on_frame) {
  MapSequence sequence{value_or_throw(open_tum_folder(options.folder)), {}};
  const InstanceTruth masks = open_masks(options.folder);
  if (options.poses == PoseSource::kTruth && !has_truth(options.folder)) {
    throw FatalError(ExitCode::kMissingInput,
                     options.folder.string() +
                         " has no groundtruth.txt; give poses with --trajectory FILE, or let slam "
                         "find them with --poses slam");
  }
  sequence.keyframes = options.poses == PoseSource::kSlam
                           ? chosen_by_slam(options, sequence.folder, masks, on_frame)
                           : every_so_many(options, sequence.folder, masks);
  if (sequence.keyframes.empty()) {
    throw FatalError(ExitCode::kEmptyInput,
                     "no frame of " + options.folder.string() +
                         " has a pose; give the trajectory of this very sequence");
  }
  return sequence;
}

}  // namespace tsg
