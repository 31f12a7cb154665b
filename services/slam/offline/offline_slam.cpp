#include "services/slam/offline/offline_slam.hpp"

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "services/slam/lib/trajectory_recorder.hpp"
#include "services/slam/offline/laps.hpp"

namespace tsg {
namespace {

LocalMapper make_mapper(const TumFolder& sequence, const OfflineOptions& options) {
  if (options.map) return {options.slam, MapContents(*options.map)};
  return {options.slam, sequence.camera.model};
}

class OfflineSlam {
 public:
  OfflineSlam(const TumFolder& sequence,
              const OfflineOptions& options,
              const OfflineHooks& hooks,
              MaskSource masks)
      : sequence_(sequence),
        hooks_(hooks),
        laps_(Laps::of(sequence, options.laps)),
        masks_(std::move(masks)),
        clock_(hooks.now_ns),
        tracker_(options.slam,
                 sequence.camera.model,
                 [this](TrackingStage stage) { clock_.begin(stage); }),
        mapper_(make_mapper(sequence, options)),
        localisation_only_(options.slam.tracker.localisation_only) {}

  Expected<void> step(int lap, std::size_t index);
  OfflineRun finish();

 private:
  [[nodiscard]] Expected<RgbdFrame> read(int lap, std::size_t index) const;
  TrackResult track(const RgbdFrame& frame, const InstanceSegmentation* mask);
  void map(TrackResult& result, const InstanceSegmentation* mask);

  const TumFolder& sequence_;
  const OfflineHooks& hooks_;
  Laps laps_;
  MaskSource masks_;
  StageClock clock_;
  Tracker tracker_;
  LocalMapper mapper_;
  bool localisation_only_;
  TrajectoryRecorder recorder_;
  OfflineRun run_;
};

Expected<RgbdFrame> OfflineSlam::read(int lap, std::size_t index) const {
  auto frame = read_frame(sequence_, index);
  if (!frame) return frame;
  frame->seq = static_cast<std::uint64_t>(lap) * sequence_.frames.size() + index;
  frame->stamp_ns = laps_.stamp_ns(lap, frame->stamp_ns);
  return frame;
}

Expected<void> OfflineSlam::step(int lap, std::size_t index) {
  const auto frame = read(lap, index);
  if (!frame) return tl::unexpected(frame.error());
  const auto mask = masks_.latest(*frame, sequence_.frames[index].stamp_ns);
  if (!mask) return tl::unexpected(mask.error());
  ++run_.frames;
  TrackResult result = track(*frame, *mask);
  OfflineFrame done{.seq = frame->seq,
                    .lap = lap,
                    .state = result.state,
                    .T_world_camera = result.T_world_camera,
                    .recorded_ns = sequence_.frames[index].stamp_ns,
                    .image = &*frame,
                    .mask = *mask,
                    .verdicts = result.verdicts,
                    .is_keyframe = result.keyframe.has_value()};
  map(result, *mask);
  const auto snapshot = mapper_.snapshot();
  done.cost = clock_.end_frame();
  done.map_keyframes = snapshot->map_keyframes;
  done.map_points = snapshot->map_points;
  if (hooks_.on_frame) hooks_.on_frame(done);
  return {};
}

TrackResult OfflineSlam::track(const RgbdFrame& frame, const InstanceSegmentation* mask) {
  clock_.start_frame();
  const auto features = tracker_.extract(frame, mask);
  clock_.start_tracking();
  TrackResult result = tracker_.track(features, *mapper_.snapshot());
  clock_.start_mapping();
  recorder_.record(result);
  if (result.T_world_camera && localisation_only_) mapper_.centre_on(result.reference);
  if (result.T_world_camera) return result;
  run_.failures.push_back("frame " + std::to_string(frame.seq) + ": " + result.reason);
  if (result.state == TrackingState::kLost) mapper_.recall(*features);
  return result;
}

void OfflineSlam::map(TrackResult& result, const InstanceSegmentation* mask) {
  mapper_.remove_points(result.dynamic_points);
  if (mask != nullptr && mask->frame_seq != result.seq) mapper_.apply_mask(*mask);
  if (!result.keyframe) return;
  mapper_.insert(std::move(*result.keyframe));
  mapper_.refine({});
  if (mapper_.is_adjusting()) ++run_.loops;
  while (mapper_.is_adjusting()) mapper_.adjust({});
}

OfflineRun OfflineSlam::finish() {
  run_.keyframes = mapper_.keyframe_poses();
  run_.live = recorder_.live(recorder_.longest_part(run_.keyframes));
  run_.corrected = recorder_.corrected(run_.keyframes);
  const auto snapshot = mapper_.snapshot();
  run_.map_keyframes = snapshot->map_keyframes;
  run_.map_points = snapshot->map_points;
  run_.map_corrections = snapshot->corrections;
  run_.map = std::make_shared<const MapContents>(mapper_.contents());
  return std::move(run_);
}

}  // namespace

Expected<OfflineRun> run_offline(const TumFolder& sequence,
                                 const OfflineOptions& options,
                                 const OfflineHooks& hooks) {
  cv::setNumThreads(1);
  auto masks = MaskSource::open(sequence.path, options.masks);
  if (!masks) return tl::unexpected(masks.error());
  OfflineSlam slam(sequence, options, hooks, std::move(*masks));
  const std::size_t end = std::min(options.end_frame, sequence.frames.size());
  for (int lap = 0; lap < options.laps; ++lap) {
    for (std::size_t i = options.first_frame; i < end; i += options.take_every_frames) {
      if (auto done = slam.step(lap, i); !done) return tl::unexpected(done.error());
    }
  }
  return slam.finish();
}

}  // namespace tsg
