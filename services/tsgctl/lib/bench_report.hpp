#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/core/statistics.hpp"

namespace tsg {

/// One frame of a measured run.
struct BenchFrame {
  std::uint64_t seq = 0;
  int lap = 0;
  bool is_tracked = false;
  bool is_keyframe = false;
  double extract_ms = 0.0;  ///< CPU time of the thread, as all of them
  double match_ms = 0.0;
  double optimise_ms = 0.0;
  double decide_ms = 0.0;
  double tracking_ms = 0.0;  ///< the sum of the above
  double mapping_ms = 0.0;
  std::size_t map_keyframes = 0;
  std::size_t map_points = 0;
  double rss_mib = 0.0;  ///< of the process
};

/// How a set of times is spread; all zero where `count` is.
struct Spread {
  std::size_t count = 0;
  double p50 = 0.0;
  double p90 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
  double mean = 0.0;
};

[[nodiscard]] Spread spread_of(std::vector<double> values);

/// All that `tsgctl bench slam` measured.
struct BenchReport {
  std::string sequence;
  int width = 0;
  int height = 0;
  bool has_masks = false;
  std::vector<BenchFrame> frames;
  std::size_t keyframes = 0;      ///< that there ever were
  std::size_t map_keyframes = 0;  ///< that are left in the map
  std::size_t map_points = 0;
  std::size_t loops = 0;
  double peak_rss_mib = 0.0;
  std::optional<Summary> ate_m;  ///< of the corrected trajectory; needs ground truth
};

/// One time through the sequence.
struct LapFigures {
  double tracking_p50_ms = 0.0;
  double rss_mib = 0.0;  ///< at its end, as the next two
  std::size_t map_keyframes = 0;
  std::size_t map_points = 0;
};

/// By lap; one for a run without laps.
[[nodiscard]] std::vector<LapFigures> figures_by_lap(const std::vector<BenchFrame>& frames);

/// For people: a table with a few lines below it.
[[nodiscard]] std::string to_text(const BenchReport& report);

/// For programs: the keys are listed in docs/tsgctl.md.
[[nodiscard]] nlohmann::json to_json(const BenchReport& report);

/// One line a frame, with a line of names above.
[[nodiscard]] std::string to_csv(const std::vector<BenchFrame>& frames);

}  // namespace tsg
