#pragma once

#include <filesystem>
#include <string>

#include "common/core/error.hpp"
#include "common/dataset/evaluation.hpp"

namespace tsg {

/// What a trajectory plot shows.
struct TrajectoryPlot {
  std::string title;    ///< for example "walking_xyz"
  Trajectory truth;     ///< drawn over the time that the estimate covers
  AbsoluteError error;  ///< the estimate, aligned, coloured by its error
};

/// The gnuplot program, data included, that draws `plot` into `png` (pixels: 1200 wide): the two
/// axes of largest extent, equal scale.
[[nodiscard]] std::string plot_script(const TrajectoryPlot& plot, const std::filesystem::path& png);

/// Draws a PNG with gnuplot; written atomically. kUnavailable where gnuplot is not installed or
/// fails, kCannotWrite where `png` cannot be written.
[[nodiscard]] Expected<void> plot_trajectory(const TrajectoryPlot& plot,
                                             const std::filesystem::path& png);

}  // namespace tsg
