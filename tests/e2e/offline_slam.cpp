#include "tests/e2e/offline_slam.hpp"

#include <algorithm>
#include <deque>
#include <optional>

#include "common/core/error.hpp"
#include "common/core/time.hpp"
#include "common/dataset/instance_truth.hpp"
#include "common/dataset/tum_folder.hpp"
#include "services/slam/lib/tracker.hpp"
#include "services/slam/lib/trajectory_recorder.hpp"

namespace tsg {
namespace {

/// Hands out true masks as late and as seldom as asked for.
class MaskSource {
 public:
  MaskSource(const std::filesystem::path& folder, const OfflineOptions& options)
      : options_(options) {
    if (options.use_masks && std::filesystem::exists(folder / "instances.json")) {
      truth_ = value_or_throw(InstanceTruth::open(folder));
    }
  }

  /// The latest mask that has come by the time of `frame`; null before the first.
  const InstanceSegmentation* latest(const RgbdFrame& frame) {
    if (!truth_) return nullptr;
    if (frame.seq % static_cast<std::uint64_t>(options_.mask_every_frames) == 0) {
      InstanceSegmentation mask = value_or_throw(truth_->at(frame.stamp_ns));
      mask.frame_seq = frame.seq;
      mask.stamp_ns = frame.stamp_ns;
      pending_.push_back(std::move(mask));
    }
    const auto delay = static_cast<std::uint64_t>(options_.mask_delay_frames);
    while (!pending_.empty() && pending_.front().frame_seq + delay <= frame.seq) {
      latest_ = std::move(pending_.front());
      pending_.pop_front();
    }
    return latest_ ? &*latest_ : nullptr;
  }

 private:
  OfflineOptions options_;
  std::optional<InstanceTruth> truth_;
  std::deque<InstanceSegmentation> pending_;
  std::optional<InstanceSegmentation> latest_;
};

double lap_ms(Stopwatch& watch) { return to_milliseconds(watch.lap_ns()); }

void map_frame(LocalMapper& mapper, TrackResult& result, const InstanceSegmentation* mask) {
  mapper.remove_points(result.dynamic_points);
  if (mask != nullptr && mask->frame_seq != result.seq) mapper.apply_mask(*mask);
  if (!result.keyframe) return;
  mapper.insert(std::move(*result.keyframe));
  mapper.refine({});
  while (mapper.is_adjusting()) mapper.adjust({});
}

}  // namespace

OfflineRun run_offline(const std::filesystem::path& folder, const OfflineOptions& options) {
  const TumFolder sequence = value_or_throw(open_tum_folder(folder));
  MaskSource masks(folder, options);
  Tracker tracker(options.slam, sequence.camera.model);
  LocalMapper mapper(options.slam, sequence.camera.model);
  TrajectoryRecorder recorder;
  OfflineRun run;
  for (std::size_t i = 0; i < sequence.frames.size(); i += options.take_every_frames) {
    ++run.frames;
    const RgbdFrame frame = value_or_throw(read_frame(sequence, i));
    const InstanceSegmentation* mask = masks.latest(frame);
    Stopwatch watch;
    const auto features = tracker.extract(frame, mask);
    run.extract_ms.push_back(lap_ms(watch));
    TrackResult result = tracker.track(features, *mapper.snapshot());
    run.track_ms.push_back(lap_ms(watch));
    recorder.record(result);
    if (!result.T_world_camera) {
      run.failures.push_back("frame " + std::to_string(i) + ": " + result.reason);
      if (result.state == TrackingState::kLost) mapper.recall(*features);
    }
    const bool is_keyframe = result.keyframe.has_value();
    map_frame(mapper, result, mask);
    if (is_keyframe) run.mapping_ms.push_back(lap_ms(watch));
  }
  run.live = recorder.live();
  run.keyframes = mapper.keyframe_poses();
  run.corrected = recorder.corrected(run.keyframes);
  run.map_keyframes = mapper.snapshot()->map_keyframes;
  run.map_points = mapper.snapshot()->map_points;
  run.map_corrections = mapper.snapshot()->corrections;
  return run;
}

}  // namespace tsg
