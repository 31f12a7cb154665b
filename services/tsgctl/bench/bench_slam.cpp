#include "services/tsgctl/bench/bench_slam.hpp"

#include <algorithm>
#include <utility>

#include "common/dataset/evaluation.hpp"
#include "services/slam/offline/laps.hpp"
#include "services/tsgctl/bench/process_use.hpp"

namespace tsg {
namespace {

TumFolder open_sequence(const BenchOptions& options) {
  TumFolder sequence = value_or_throw(open_tum_folder(options.folder));
  if (options.frames > 0 && options.frames < sequence.frames.size()) {
    sequence.frames.resize(options.frames);
  }
  if (options.run.laps > 1 && sequence.frames.size() < 2) {
    throw FatalError(ExitCode::kEmptyInput, options.folder.string() +
                                                " has too few frames to be gone round; give a "
                                                "sequence of two or more, or leave out --laps");
  }
  return sequence;
}

BenchFrame measured(const OfflineFrame& frame) {
  return {.seq = frame.seq,
          .lap = frame.lap,
          .is_tracked = frame.state == TrackingState::kTracking,
          .is_keyframe = frame.is_keyframe,
          .extract_ms = frame.cost.extract_ms,
          .match_ms = frame.cost.match_ms,
          .optimise_ms = frame.cost.optimise_ms,
          .decide_ms = frame.cost.decide_ms,
          .tracking_ms = frame.cost.tracking_ms(),
          .mapping_ms = frame.cost.mapping_ms,
          .map_keyframes = frame.map_keyframes,
          .map_points = frame.map_points,
          .rss_mib = resident_mib()};
}

std::optional<Summary> measure_ate(const TumFolder& sequence,
                                   int laps,
                                   const Trajectory& estimate) {
  const std::filesystem::path file = sequence.path / "groundtruth.txt";
  if (!std::filesystem::exists(file)) return std::nullopt;
  const Trajectory truth = Laps::of(sequence, laps).repeat(value_or_throw(read_trajectory(file)));
  const auto error = absolute_error(truth, estimate);
  // Too few poses to compare is a fact about the run, which has figures worth telling all the same.
  if (!error) return std::nullopt;
  return error->translation_m;
}

}  // namespace

BenchResult bench_slam(
    const BenchOptions& options,
    const std::function<void(std::uint64_t done, std::uint64_t total)>& on_progress) {
  const TumFolder sequence = open_sequence(options);
  BenchReport report{.sequence = sequence.path.lexically_normal().string(),
                     .width = sequence.camera.model.width,
                     .height = sequence.camera.model.height,
                     .has_masks = options.run.masks.use &&
                                  std::filesystem::exists(sequence.path / "instances.json"),
                     .frames = {},
                     .ate_m = std::nullopt};
  const std::size_t total = sequence.frames.size() * static_cast<std::size_t>(options.run.laps);
  report.frames.reserve(total);
  const OfflineHooks hooks{.now_ns = thread_cpu_ns, .on_frame = [&](const OfflineFrame& frame) {
                             report.frames.push_back(measured(frame));
                             if (options.on_frame) options.on_frame(frame);
                             on_progress(report.frames.size(), total);
                           }};
  OfflineRun run = value_or_throw(run_offline(sequence, options.run, hooks));
  report.keyframes = run.keyframes.size();
  report.map_keyframes = run.map_keyframes;
  report.map_points = run.map_points;
  report.loops = run.loops;
  report.peak_rss_mib = peak_resident_mib();
  report.ate_m = measure_ate(sequence, options.run.laps, run.corrected);
  return {std::move(report), std::move(run.corrected)};
}

}  // namespace tsg
