#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "common/dataset/trajectory.hpp"
#include "services/tsgctl/lib/run_plan.hpp"

namespace tsg {

/// What a run has to know of its input before anything is started.
struct Sequence {
  std::uint64_t frames = 0;
  std::optional<Trajectory> ground_truth;
};

/// Whether the folder has true masks to take as segmentation.
[[nodiscard]] bool has_true_masks(const std::filesystem::path& folder);

/// Opens the sequence and what the options need of it, so that a mistake is told at once and not by
/// a service. Images are not decoded. Throws FatalError naming the file.
[[nodiscard]] Sequence open_sequence(const RunOptions& options);

}  // namespace tsg
