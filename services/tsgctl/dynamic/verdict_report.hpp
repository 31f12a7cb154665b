#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/tsgctl/dynamic/verdict_score.hpp"
#include "services/tsgctl/lib/run_report.hpp"

namespace tsg {

// What the verdicts shall reach with masks of good quality.
inline constexpr double kRecallTarget = 0.97;
inline constexpr double kPrecisionTarget = 0.95;
inline constexpr double kRemovedTarget = 0.95;  ///< of the frames in which an instance moves
inline constexpr double kKeptTarget = 0.90;     ///< of the frames of an instance that never moves

/// All that `tsgctl eval dynamic` found.
struct VerdictReport {
  std::string sequence;
  std::string method;
  std::string masks;  ///< which came: "true masks", "no masks", "true masks, 6 frames late"
  int margin_px = 0;
  std::size_t frames_lost = 0;
  std::optional<TrajectoryAccuracy> accuracy;  ///< needs ground truth of the camera
  std::vector<FrameScore> scores;
};

/// Names of FeatureKind, for tables and as keys.
inline constexpr std::array<const char*, kFeatureKinds> kKindTitles{
    "static things", "dynamic classes", "potentially dynamic, moving", "potentially dynamic, still",
    "other things that move"};

/// For people: tables with the targets beside.
[[nodiscard]] std::string to_text(const VerdictReport& report);

/// For programs: the keys are listed in docs/dynamic-features.md.
[[nodiscard]] nlohmann::json to_json(const VerdictReport& report);
[[nodiscard]] nlohmann::json to_json(const VerdictSummary& summary);

/// One line a frame, with a line of names above; shares that a frame has not are left empty.
[[nodiscard]] std::string to_csv(const std::vector<FrameScore>& scores);

/// `count` by frame; 0 without frames.
[[nodiscard]] double per_frame(std::uint64_t count, std::size_t frames);

}  // namespace tsg
