#pragma once

#include <filesystem>
#include <optional>

#include "common/dataset/trajectory.hpp"
#include "services/tsgctl/lib/run_report.hpp"

namespace tsg {

/// ATE and RPE; nothing where the trajectories share too few moments to be compared.
[[nodiscard]] std::optional<TrajectoryAccuracy> measure_accuracy(const Trajectory& truth,
                                                                 const Trajectory& estimate);

/// Those of the trajectory in a file; nothing where the file is absent or shares too few
/// moments with the truth to be compared.
[[nodiscard]] std::optional<TrajectoryAccuracy> measure_accuracy(
    const Trajectory& truth, const std::filesystem::path& estimate);

}  // namespace tsg
