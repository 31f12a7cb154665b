#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/tsgctl/lib/bench_report.hpp"

namespace tsg {

/// The gnuplot program, data included, that draws tracking time, memory and size of the map over
/// the frames of a run into `png` (1200 x 1100 pixels). Times are drawn as medians and 99th
/// percentiles of stretches of the run. `report` must have frames.
[[nodiscard]] std::string scale_plot_script(const BenchReport& report,
                                            const std::filesystem::path& png);

/// Draws it; errors are those of draw_png().
[[nodiscard]] Expected<void> plot_scale(const BenchReport& report,
                                        const std::filesystem::path& png);

}  // namespace tsg
