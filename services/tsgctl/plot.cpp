#include "services/tsgctl/plot.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <sstream>
#include <vector>

#include "services/tsgctl/gnuplot.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

/// Indices of the horizontal and the vertical axis of the picture.
struct Axes {
  int horizontal = 0;
  int vertical = 1;
};

constexpr std::array<const char*, 3> kAxisNames{"x", "y", "z"};

/// The part of the truth between the first and the last pose of the estimate.
Trajectory covered_truth(const TrajectoryPlot& plot) {
  const std::int64_t from = plot.error.matched.front().stamp_ns - kDefaultMaxDifferenceNs;
  const std::int64_t to = plot.error.matched.back().stamp_ns + kDefaultMaxDifferenceNs;
  Trajectory covered;
  std::copy_if(
      plot.truth.begin(), plot.truth.end(), std::back_inserter(covered),
      [&](const StampedPose& pose) { return from <= pose.stamp_ns && pose.stamp_ns <= to; });
  return covered;
}

Axes widest_axes(const std::vector<MatchedPose>& matched) {
  Eigen::Vector3d low = matched.front().T_world_truth.translation();
  Eigen::Vector3d high = low;
  for (const MatchedPose& pose : matched) {
    low = low.cwiseMin(pose.T_world_truth.translation());
    high = high.cwiseMax(pose.T_world_truth.translation());
  }
  int flattest = 0;
  (high - low).minCoeff(&flattest);
  return {flattest == 0 ? 1 : 0, flattest == 2 ? 1 : 2};
}

void write_point(std::ostream& script, const Eigen::Vector3d& p_world, const Axes& axes) {
  script << p_world[axes.horizontal] << ' ' << p_world[axes.vertical];
}

void write_truth(std::ostream& script, const Trajectory& truth, const Axes& axes) {
  script << "$truth << EOD\n";
  for (const StampedPose& pose : truth) {
    write_point(script, pose.T_world_camera.translation(), axes);
    script << '\n';
  }
  script << "EOD\n";
}

/// The longest time between two poses that still counts as tracked through.
std::int64_t longest_step_ns(const std::vector<MatchedPose>& matched) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < matched.size(); ++i) {
    steps.push_back(matched[i].stamp_ns - matched[i - 1].stamp_ns);
  }
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                   steps.end());
  return 5 * steps[steps.size() / 2];
}

/// Columns: place, error in millimetres. A blank line, where tracking was lost, ends a line.
void write_estimate(std::ostream& script, const AbsoluteError& error, const Axes& axes) {
  const std::int64_t longest_ns = longest_step_ns(error.matched);
  script << "$estimate << EOD\n";
  for (std::size_t i = 0; i < error.matched.size(); ++i) {
    const MatchedPose& pose = error.matched[i];
    if (i > 0 && pose.stamp_ns - error.matched[i - 1].stamp_ns > longest_ns) script << '\n';
    write_point(script, error.T_world_estimate * pose.T_estimate_camera.translation(), axes);
    script << ' ' << 1000.0 * error.errors_m[i] << '\n';
  }
  script << "EOD\n";
}

void write_start(std::ostream& script, const AbsoluteError& error, const Axes& axes) {
  script << "$start << EOD\n";
  write_point(script,
              error.T_world_estimate * error.matched.front().T_estimate_camera.translation(), axes);
  script << "\nEOD\n";
}

/// The part of both axes that is shown: all poses with a margin, and of the shorter axis no less
/// than a good part of the longer, lest a straight path becomes a narrow strip.
void write_ranges(std::ostream& script, const AbsoluteError& error, const Axes& axes) {
  constexpr double kMargin = 1.1;
  constexpr double kNarrowest = 0.6;
  Eigen::Array3d low = error.matched.front().T_world_truth.translation();
  Eigen::Array3d high = low;
  for (const MatchedPose& pose : error.matched) {
    const Eigen::Array3d truth = pose.T_world_truth.translation();
    const Eigen::Array3d estimate = error.T_world_estimate * pose.T_estimate_camera.translation();
    low = low.min(truth).min(estimate);
    high = high.max(truth).max(estimate);
  }
  const Eigen::Array3d size = high - low;
  const double longest = std::max({size[axes.horizontal], size[axes.vertical], 1e-3});
  const auto write = [&](const char* name, int axis) {
    const double half = 0.5 * kMargin * std::max(size[axis], kNarrowest * longest);
    const double middle = 0.5 * (low[axis] + high[axis]);
    script << "set " << name << " [" << middle - half << ":" << middle + half << "]\n";
  };
  write("xrange", axes.horizontal);
  write("yrange", axes.vertical);
}

std::string subtitle(const Summary& error_m) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << "ATE RMSE " << 1000.0 * error_m.rmse
       << " mm, median " << 1000.0 * error_m.median << " mm, max " << 1000.0 * error_m.max
       << " mm over " << error_m.count << " poses";
  return text.str();
}

void write_style(std::ostream& script, const TrajectoryPlot& plot, const Axes& axes) {
  // The scale of colour ends where the few worst poses would take all contrast from the others.
  const double top_mm = std::max(1000.0 * plot.error.translation_m.p99, 1e-3);
  script << "set title " << gnuplot_text(plot.title) << " . \"\\n\" . "
         << gnuplot_text(subtitle(plot.error.translation_m)) << " noenhanced font ',15'\n"
         << "set xlabel '" << kAxisNames.at(static_cast<std::size_t>(axes.horizontal)) << " [m]'\n"
         << "set ylabel '" << kAxisNames.at(static_cast<std::size_t>(axes.vertical)) << " [m]'\n"
         << "set cblabel 'position error [mm]' offset 1.5,0\n"
         << "set cbrange [0:" << top_mm << "]\n"
         << "set palette defined (0 '#2c7bb6', 0.35 '#00a6ca', 0.55 '#90c987', 0.75 '#f9a03f', "
            "1 '#d7191c')\n"
         << "set size ratio -1\n"
         << "set grid lt 1 lc rgb '#dddddd' lw 1\nset border lc rgb '#606060'\nset tics nomirror\n"
         << "set bmargin at screen 0.15\nset tmargin at screen 0.90\n"
         << "set key at screen 0.5, screen 0.03 center bottom horizontal Left reverse samplen 3\n";
}

}  // namespace

std::string plot_script(const TrajectoryPlot& plot, const fs::path& png) {
  const Axes axes = widest_axes(plot.error.matched);
  std::ostringstream script;
  script << std::setprecision(9) << "set encoding utf8\n"
         << "set terminal pngcairo rounded size 1200,900 font 'sans,13' background '#ffffff'\n"
         << "set output " << gnuplot_text(png.string()) << '\n';
  write_truth(script, covered_truth(plot), axes);
  write_estimate(script, plot.error, axes);
  write_start(script, plot.error, axes);
  write_ranges(script, plot.error, axes);
  write_style(script, plot, axes);
  script << "plot $truth using 1:2 with lines lw 5 lc rgb '#b8b8b8' title 'ground truth', "
            "$estimate using 1:2:3 with lines lw 2.5 lc palette title 'estimate, aligned', "
            "$start using 1:2 with points pt 7 ps 1.8 lc rgb '#202020' title 'start'\n";
  return script.str();
}

Expected<void> plot_trajectory(const TrajectoryPlot& plot, const fs::path& png) {
  return draw_png([&](const fs::path& picture) { return plot_script(plot, picture); }, png);
}

}  // namespace tsg
