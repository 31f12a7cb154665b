#pragma once

#include <filesystem>
#include <vector>

#include "common/core/error.hpp"
#include "services/slam/lib/trajectory_recorder.hpp"

namespace tsg {

/// Writes, in TUM format with poses in `map`: trajectory.txt (every tracked frame, corrected by
/// its keyframe), trajectory_live.txt (as published), keyframes.txt (from `first_of_session` on:
/// those before came with a map). kCannotWrite names the file.
[[nodiscard]] Expected<void> save_results(const std::filesystem::path& folder,
                                          const TrajectoryRecorder& recorder,
                                          const std::vector<KeyframePose>& keyframes,
                                          KeyframeId first_of_session);

}  // namespace tsg
