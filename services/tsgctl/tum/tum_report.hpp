#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/tsgctl/lib/run_report.hpp"

namespace tsg {

/// One run over a sequence.
struct TumRun {
  std::uint64_t frames = 0;  ///< answered
  std::uint64_t lost = 0;
  TrajectoryAccuracy accuracy;
};

/// What became of one sequence.
struct TumSequenceResult {
  std::string name;                  ///< "fr3/walking_xyz"
  std::optional<TumRun> plain = {};  ///< without removal of dynamic features
  std::optional<TumRun> tsg = {};    ///< with it; needs masks
  std::string problem = {};          ///< why a run is missing; empty where none failed
};

/// All that `tsgctl eval-tum` found.
struct TumReport {
  std::vector<int>
      tables;  ///< of the paper, that were asked for; sequences outside come after them
  std::string segmentation;  ///< "off", "dataset" or "model"
  std::string model;
  std::vector<TumSequenceResult> sequences;
  std::vector<std::string> missing;  ///< names of sequences that have not been fetched
  std::string fetch_command;         ///< that gets them; empty where none is missing
};

/// For people: the paper's tables with this system's figures beside.
[[nodiscard]] std::string to_text(const TumReport& report);

/// For programs: the keys are listed in docs/evaluation.md.
[[nodiscard]] nlohmann::json to_json(const TumReport& report);

}  // namespace tsg
