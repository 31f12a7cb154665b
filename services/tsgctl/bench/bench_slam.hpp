#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "common/geometry/stamped_pose.hpp"
#include "services/slam/offline/offline_slam.hpp"
#include "services/tsgctl/lib/bench_report.hpp"

namespace tsg {

/// What `tsgctl bench slam` is asked for.
struct BenchOptions {
  std::filesystem::path folder;  ///< in TUM layout
  std::size_t frames = 0;        ///< the first so many of the sequence; 0: all
  OfflineOptions run = {};
  std::function<void(const OfflineFrame&)> on_frame = {};  ///< sees each frame, off the clock
};

struct BenchResult {
  BenchReport report;
  Trajectory trajectory;  ///< corrected
};

/// Runs the core over the sequence and measures the CPU time of the calling thread, which does all
/// the work. `on_progress` is told how many frames of how many are done. Throws FatalError where
/// the sequence cannot be read.
[[nodiscard]] BenchResult bench_slam(
    const BenchOptions& options,
    const std::function<void(std::uint64_t done, std::uint64_t total)>& on_progress);

}  // namespace tsg
