#include "services/tsgctl/lib/bench_report.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <sstream>

#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

using nlohmann::json;

struct Stage {
  const char* name;
  double BenchFrame::*ms;
};
constexpr std::array<Stage, 5> kStages{{{"extract", &BenchFrame::extract_ms},
                                        {"match", &BenchFrame::match_ms},
                                        {"optimise", &BenchFrame::optimise_ms},
                                        {"decide", &BenchFrame::decide_ms},
                                        {"tracking", &BenchFrame::tracking_ms}}};

Spread spread_of(const std::vector<BenchFrame>& frames, double BenchFrame::*ms) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const BenchFrame& frame : frames) values.push_back(frame.*ms);
  return tsg::spread_of(std::move(values));
}

Spread mapping_per_keyframe(const std::vector<BenchFrame>& frames) {
  std::vector<double> values;
  for (const BenchFrame& frame : frames) {
    if (frame.is_keyframe) values.push_back(frame.mapping_ms);
  }
  return tsg::spread_of(std::move(values));
}

std::size_t lost_frames(const std::vector<BenchFrame>& frames) {
  return static_cast<std::size_t>(std::count_if(
      frames.begin(), frames.end(), [](const BenchFrame& frame) { return !frame.is_tracked; }));
}

std::vector<std::string> row_of(const std::string& name, const Spread& spread) {
  return {name,
          fixed(spread.p50, 2),
          fixed(spread.p90, 2),
          fixed(spread.p99, 2),
          fixed(spread.max, 2),
          fixed(spread.mean, 2)};
}

json to_json(const Spread& spread) {
  return {{"count", spread.count}, {"p50", spread.p50}, {"p90", spread.p90},
          {"p99", spread.p99},     {"max", spread.max}, {"mean", spread.mean}};
}

json to_json(const LapFigures& lap) {
  return {{"tracking_p50_ms", lap.tracking_p50_ms},
          {"rss_mib", lap.rss_mib},
          {"map_keyframes", lap.map_keyframes},
          {"map_points", lap.map_points}};
}

std::string times_table(const BenchReport& report) {
  std::vector<std::vector<std::string>> rows{{"CPU ms", "p50", "p90", "p99", "max", "mean"}};
  for (const Stage& stage : kStages) {
    rows.push_back(row_of(stage.name, spread_of(report.frames, stage.ms)));
  }
  const Spread mapping = mapping_per_keyframe(report.frames);
  rows.push_back(row_of("mapping", mapping));
  return format_table(rows) +
         "Per frame, of one thread, without reading images; mapping: per keyframe, over " +
         std::to_string(mapping.count) + ".\n";
}

std::string map_lines(const BenchReport& report) {
  std::string text =
      "frames     " + std::to_string(report.frames.size()) + ", " +
      std::to_string(lost_frames(report.frames)) + " without a pose\n" + "map        " +
      std::to_string(report.map_keyframes) + " keyframes of " + std::to_string(report.keyframes) +
      " made, " + std::to_string(report.map_points) + " points, " + std::to_string(report.loops) +
      " loops closed\n" + "memory     " + fixed(report.peak_rss_mib, 0) + " MiB at most\n";
  if (!report.ate_m) return text + "ATE        no ground truth\n";
  return text + "ATE        rmse " + fixed(report.ate_m->rmse, 4) + " m, median " +
         fixed(report.ate_m->median, 4) + " m, max " + fixed(report.ate_m->max, 4) + " m over " +
         std::to_string(report.ate_m->count) + " poses\n";
}

/// "+3.1 %".
std::string change(double before, double after) {
  if (before <= 0.0) return "-";
  const double percent = 100.0 * (after - before) / before;
  return (percent >= 0.0 ? "+" : "") + fixed(percent, 1) + " %";
}

std::string laps_table(const std::vector<LapFigures>& laps) {
  const LapFigures& first = laps.front();
  const LapFigures& last = laps.back();
  const auto row = [](const std::string& name, const LapFigures& lap) {
    return std::vector<std::string>{name, fixed(lap.tracking_p50_ms, 2), fixed(lap.rss_mib, 0),
                                    std::to_string(lap.map_keyframes),
                                    std::to_string(lap.map_points)};
  };
  const auto percent = [](std::size_t before, std::size_t after) {
    return change(static_cast<double>(before), static_cast<double>(after));
  };
  return "\n" + format_table({{"", "tracking p50 ms", "MiB", "keyframes", "points"},
                              row("first lap", first),
                              row("lap " + std::to_string(laps.size()), last),
                              {"change", change(first.tracking_p50_ms, last.tracking_p50_ms),
                               change(first.rss_mib, last.rss_mib),
                               percent(first.map_keyframes, last.map_keyframes),
                               percent(first.map_points, last.map_points)}});
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {.count = values.size(),
          .p50 = quantile(values, 0.5),
          .p90 = quantile(values, 0.9),
          .p99 = quantile(values, 0.99),
          .max = values.back(),
          .mean = sum / static_cast<double>(values.size())};
}

std::vector<LapFigures> figures_by_lap(const std::vector<BenchFrame>& frames) {
  std::vector<LapFigures> laps;
  auto from = frames.begin();
  while (from != frames.end()) {
    const auto to = std::find_if(from, frames.end(),
                                 [&](const BenchFrame& frame) { return frame.lap != from->lap; });
    const BenchFrame& last = *std::prev(to);
    laps.push_back({.tracking_p50_ms = spread_of({from, to}, &BenchFrame::tracking_ms).p50,
                    .rss_mib = last.rss_mib,
                    .map_keyframes = last.map_keyframes,
                    .map_points = last.map_points});
    from = to;
  }
  return laps;
}

std::string to_text(const BenchReport& report) {
  const std::vector<LapFigures> laps = figures_by_lap(report.frames);
  return report.sequence + ", " + std::to_string(report.width) + "x" +
         std::to_string(report.height) + ", " +
         (report.has_masks ? "with true masks" : "without masks") + "\n\n" + times_table(report) +
         "\n" + map_lines(report) + (laps.size() > 1 ? laps_table(laps) : "");
}

json to_json(const BenchReport& report) {
  json cpu_ms;
  for (const Stage& stage : kStages) {
    cpu_ms[stage.name] = to_json(spread_of(report.frames, stage.ms));
  }
  cpu_ms["mapping_per_keyframe"] = to_json(mapping_per_keyframe(report.frames));
  json laps = json::array();
  for (const LapFigures& lap : figures_by_lap(report.frames)) laps.push_back(to_json(lap));
  json root{{"sequence", report.sequence},
            {"width", report.width},
            {"height", report.height},
            {"masks", report.has_masks},
            {"frames", report.frames.size()},
            {"frames_lost", lost_frames(report.frames)},
            {"cpu_ms", std::move(cpu_ms)},
            {"keyframes", report.keyframes},
            {"map_keyframes", report.map_keyframes},
            {"map_points", report.map_points},
            {"loops", report.loops},
            {"peak_rss_mib", report.peak_rss_mib},
            {"laps", std::move(laps)},
            {"ate_m", nullptr}};
  if (report.ate_m) {
    root["ate_m"] = {{"count", report.ate_m->count}, {"rmse", report.ate_m->rmse},
                     {"mean", report.ate_m->mean},   {"median", report.ate_m->median},
                     {"std", report.ate_m->std_dev}, {"max", report.ate_m->max}};
  }
  return root;
}

std::string to_csv(const std::vector<BenchFrame>& frames) {
  std::ostringstream text;
  text << "seq,lap,tracked,keyframe,extract_ms,match_ms,optimise_ms,decide_ms,tracking_ms,"
          "mapping_ms,map_keyframes,map_points,rss_mib\n";
  for (const BenchFrame& frame : frames) {
    text << frame.seq << ',' << frame.lap << ',' << frame.is_tracked << ',' << frame.is_keyframe;
    for (const Stage& stage : kStages) text << ',' << fixed(frame.*stage.ms, 3);
    text << ',' << fixed(frame.mapping_ms, 3) << ',' << frame.map_keyframes << ','
         << frame.map_points << ',' << fixed(frame.rss_mib, 1) << '\n';
  }
  return text.str();
}

}  // namespace tsg
