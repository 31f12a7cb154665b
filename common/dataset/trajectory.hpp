#pragma once

#include <filesystem>

#include "common/core/error.hpp"
#include "common/dataset/stamp.hpp"
#include "common/geometry/stamped_pose.hpp"

namespace tsg {

/// Reads a file in TUM format, a pose a line: stamp tx ty tz qx qy qz qw. Lines may be in any
/// order; of lines with one stamp the first counts. Errors: kMissingInput, kEmptyInput, kBadData
/// for a malformed line, kInvalidNumber for NaN or infinity; they name file and line.
[[nodiscard]] Expected<Trajectory> read_trajectory(const std::filesystem::path& path);

/// The same for "what a user names": a trajectory file, or a TUM folder, meaning its
/// groundtruth.txt.
[[nodiscard]] Expected<Trajectory> read_ground_truth(const std::filesystem::path& file_or_folder);

/// Writes TUM format, atomically; kCannotWrite, kInvalidNumber for a pose that is not finite.
[[nodiscard]] Expected<void> write_trajectory(
    const std::filesystem::path& path,
    const Trajectory& trajectory,
    StampDecimals decimals = StampDecimals::kMicroseconds);

}  // namespace tsg
