#include "services/tsgctl/bench/scale_plot.hpp"

#include <algorithm>
#include <sstream>

#include "services/tsgctl/gnuplot.hpp"

namespace tsg {
namespace {

constexpr std::size_t kStretches = 120;  // as many as can be told apart in the picture

std::size_t stretch_length(std::size_t frames) {
  return std::max<std::size_t>(1, (frames + kStretches - 1) / kStretches);
}

/// Columns: middle of the stretch, median and 99th percentile of tracking, memory, keyframes,
/// points.
void write_stretches(std::ostream& script, const std::vector<BenchFrame>& frames) {
  const std::size_t length = stretch_length(frames.size());
  script << "$run << EOD\n";
  for (std::size_t from = 0; from < frames.size(); from += length) {
    const std::size_t to = std::min(from + length, frames.size());
    std::vector<double> tracking_ms;
    for (std::size_t i = from; i < to; ++i) tracking_ms.push_back(frames[i].tracking_ms);
    const Spread spread = spread_of(std::move(tracking_ms));
    const BenchFrame& last = frames[to - 1];
    script << (from + to) / 2 << ' ' << spread.p50 << ' ' << spread.p99 << ' ' << last.rss_mib
           << ' ' << last.map_keyframes << ' ' << 0.001 * static_cast<double>(last.map_points)
           << '\n';
  }
  script << "EOD\n";
}

std::string heading(const BenchReport& report) {
  const std::size_t laps = figures_by_lap(report.frames).size();
  return report.sequence + ", " + std::to_string(report.width) + "x" +
         std::to_string(report.height) + ": " + std::to_string(report.frames.size()) + " frames" +
         (laps > 1 ? ", " + std::to_string(laps) + " times round" : "");
}

void write_times(std::ostream& script) {
  script << "set ylabel 'tracking [CPU ms]'\nset yrange [0:*]\n"
         << "plot $run using 1:3 with lines lw 1.5 lc rgb '#f9a03f' title '99th percentile', "
            "$run using 1:2 with lines lw 2.5 lc rgb '#2c7bb6' title 'median'\n";
}

void write_memory(std::ostream& script) {
  script << "set ylabel 'memory [MiB]'\nset yrange [0:*]\n"
         << "plot $run using 1:4 with lines lw 2.5 lc rgb '#d7191c' title 'resident memory'\n";
}

void write_map(std::ostream& script) {
  script << "set ylabel 'keyframes'\nset y2label 'points [thousands]'\nset y2range [0:*]\n"
         << "set y2tics nomirror\nset xlabel 'frame'\n"
         << "plot $run using 1:5 with lines lw 2.5 lc rgb '#202020' title 'keyframes', "
            "$run using 1:6 axes x1y2 with lines lw 2.5 lc rgb '#4dac26' title 'points'\n";
}

}  // namespace

std::string scale_plot_script(const BenchReport& report, const std::filesystem::path& png) {
  std::ostringstream script;
  script << "set encoding utf8\n"
         << "set terminal pngcairo rounded size 1200,1100 font 'sans,13' background '#ffffff'\n"
         << "set output " << gnuplot_text(png.string()) << '\n';
  write_stretches(script, report.frames);
  script << "set multiplot layout 3,1 title " << gnuplot_text(heading(report))
         << " noenhanced font ',15'\n"
         << "set xrange [0:" << report.frames.size() << "]\n"
         << "set grid lt 1 lc rgb '#dddddd' lw 1\nset border lc rgb '#606060'\nset tics nomirror\n"
         << "set key bottom right horizontal\nset lmargin 10\nset rmargin 10\n";
  write_times(script);
  write_memory(script);
  write_map(script);
  script << "unset multiplot\n";
  return script.str();
}

Expected<void> plot_scale(const BenchReport& report, const std::filesystem::path& png) {
  return draw_png(
      [&](const std::filesystem::path& picture) { return scale_plot_script(report, picture); },
      png);
}

}  // namespace tsg
