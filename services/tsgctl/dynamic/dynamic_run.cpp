#include "services/tsgctl/dynamic/dynamic_run.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "common/core/atomic_file.hpp"
#include "services/tsgctl/dynamic/debug_picture.hpp"
#include "services/tsgctl/run/accuracy.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

FrameScore score(const OfflineFrame& frame,
                 const InstanceTruth& truth,
                 const DynamicOptions& options) {
  const TrueMask mask = value_or_throw(truth.mask_at(frame.recorded_ns));
  if (mask.segmentation.labels.size() != frame.image->colour.size()) {
    throw FatalError(ExitCode::kSizeMismatch,
                     "the true mask of frame " + std::to_string(frame.seq) +
                         " differs in size from its image; render the sequence anew");
  }
  FrameScore score = score_frame(
      *frame.verdicts, make_frame_truth(mask, truth.instances(),
                                        options.bench.run.slam.dynamic_filter, options.margin_px));
  score.seq = frame.seq;
  score.stamp_ns = frame.recorded_ns;
  score.is_tracked = frame.state == TrackingState::kTracking;
  return score;
}

/// "000042.png".
std::string picture_name(std::uint64_t seq) {
  const std::string digits = std::to_string(seq);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits + ".png";
}

bool is_picture_name(const std::string& name) {
  const std::size_t digits = name.find_first_not_of("0123456789");
  return digits >= 6 && digits != std::string::npos && name.substr(digits) == ".png";
}

void write_picture(const OfflineFrame& frame, const DynamicOptions& options) {
  const auto every = static_cast<std::uint64_t>(options.debug.every_frames);
  if (options.debug.folder.empty() || frame.seq % every != 0) return;
  const cv::Mat picture = draw_verdicts({.seq = frame.seq,
                                         .is_tracked = frame.state == TrackingState::kTracking,
                                         .colour = frame.image->colour,
                                         .mask = frame.mask,
                                         .verdicts = frame.verdicts.get(),
                                         .config = &options.bench.run.slam.dynamic_filter});
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes);
  throw_on_error(write_file_atomically(options.debug.folder / picture_name(frame.seq),
                                       std::string(bytes.begin(), bytes.end())));
}

std::optional<TrajectoryAccuracy> accuracy_of(const fs::path& folder, const Trajectory& estimate) {
  const fs::path file = folder / "groundtruth.txt";
  if (!fs::exists(file)) return std::nullopt;
  return measure_accuracy(value_or_throw(read_trajectory(file)), estimate);
}

}  // namespace

std::size_t DynamicRun::frames_lost() const {
  return static_cast<std::size_t>(std::count_if(bench.frames.begin(), bench.frames.end(),
                                                [](const BenchFrame& f) { return !f.is_tracked; }));
}

void prepare(const DebugPictures& debug) {
  if (debug.folder.empty()) return;
  throw_on_error(make_folder(debug.folder));
  std::error_code ignored;  // what cannot be removed cannot be written either: told then
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(debug.folder, ignored)) {
    if (is_picture_name(entry.path().filename().string())) old.push_back(entry.path());
  }
  for (const fs::path& path : old) fs::remove(path, ignored);
}

DynamicRun run_dynamic(
    const DynamicOptions& options,
    const InstanceTruth* truth,
    const std::function<void(std::uint64_t done, std::uint64_t total)>& on_progress) {
  DynamicRun run;
  BenchOptions bench = options.bench;
  bench.on_frame = [&](const OfflineFrame& frame) {
    if (truth != nullptr) run.scores.push_back(score(frame, *truth, options));
    write_picture(frame, options);
  };
  BenchResult result = bench_slam(bench, on_progress);
  run.accuracy = accuracy_of(bench.folder, result.trajectory);
  run.bench = std::move(result.report);
  return run;
}

}  // namespace tsg
