#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "common/dataset/instance_truth.hpp"
#include "services/tsgctl/bench/bench_slam.hpp"
#include "services/tsgctl/dynamic/verdict_score.hpp"
#include "services/tsgctl/lib/run_report.hpp"

namespace tsg {

/// Pictures of what was judged, as FOLDER/NNNNNN.png; the folder must be there.
struct DebugPictures {
  std::filesystem::path folder;  ///< empty: none
  int every_frames = 10;
};

struct DynamicOptions {
  BenchOptions bench;  ///< without on_frame, which is used here
  int margin_px = 4;   ///< for make_frame_truth(); a corner is made by pixels up to 3 beside it
  DebugPictures debug = {};
};

/// One run over a sequence with all that is measured of it.
struct DynamicRun {
  BenchReport bench;
  std::optional<TrajectoryAccuracy> accuracy;  ///< needs ground truth
  std::vector<FrameScore> scores;              ///< of each frame; empty without `truth`

  [[nodiscard]] std::size_t frames_lost() const;
};

/// Runs the core over the sequence and compares what it judges with `truth`, which may be null:
/// then nothing is compared. Throws FatalError where a file cannot be read or a picture not be
/// written.
[[nodiscard]] DynamicRun run_dynamic(
    const DynamicOptions& options,
    const InstanceTruth* truth,
    const std::function<void(std::uint64_t done, std::uint64_t total)>& on_progress);

/// Makes the folder, if there is to be one, and removes the pictures of an earlier run from it.
/// Throws FatalError (kCannotWrite).
void prepare(const DebugPictures& debug);

}  // namespace tsg
