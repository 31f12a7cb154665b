#include "services/tsgctl/lib/progress_line.hpp"

#include <algorithm>

#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

/// Done part of the whole, 0..1: more frames than announced do not overflow the bar.
double fraction_done(const ProgressState& progress) {
  if (progress.frames_total == 0) return 0.0;
  return std::min(
      1.0, static_cast<double>(progress.frames_done) / static_cast<double>(progress.frames_total));
}

std::string percent(const ProgressState& progress) {
  return std::to_string(static_cast<int>(fraction_done(progress) * 100.0)) + " %";
}

std::string count(const ProgressState& progress) {
  return std::to_string(progress.frames_done) + "/" + std::to_string(progress.frames_total);
}

/// "ETA 0:05"; "ETA -" until there is a rate to tell it from.
std::string eta(const ProgressState& progress) {
  const double fps = frames_per_second(progress);
  if (fps <= 0.0) return "ETA -";
  const auto left = progress.frames_total - std::min(progress.frames_total, progress.frames_done);
  return "ETA " + format_duration(static_cast<double>(left) / fps);
}

}  // namespace

double frames_per_second(const ProgressState& progress) {
  if (progress.elapsed_s <= 0.0) return 0.0;
  return static_cast<double>(progress.frames_done) / progress.elapsed_s;
}

std::string progress_bar(const ProgressState& progress, int columns) {
  const std::string facts = " " + count(progress) + "  " + percent(progress) + "  " +
                            progress.state + "  " + fixed(frames_per_second(progress), 1) +
                            " fps  " + eta(progress);
  constexpr int kWidest = 40;
  constexpr int kNarrowest = 5;
  const int room = columns - static_cast<int>(facts.size()) - 2;
  if (room < kNarrowest) return facts.substr(1, static_cast<std::size_t>(std::max(columns, 1)));
  const auto width = static_cast<std::size_t>(std::min(room, kWidest));
  const auto filled =
      static_cast<std::size_t>(fraction_done(progress) * static_cast<double>(width));
  return "[" + std::string(filled, '#') + std::string(width - filled, '-') + "]" + facts;
}

std::string progress_text(const ProgressState& progress) {
  return "frame " + count(progress) + " (" + percent(progress) + ") " + progress.state + " " +
         fixed(frames_per_second(progress), 1) + " fps " + eta(progress);
}

}  // namespace tsg
