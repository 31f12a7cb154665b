#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/tsgctl/dynamic/verdict_score.hpp"
#include "services/tsgctl/lib/run_report.hpp"

namespace tsg {

/// One method, or one variant of method "full", on one sequence.
struct MethodRun {
  std::string name;          ///< "tsg", "late6"
  std::string problem = {};  ///< why there are no figures; empty where there are
  std::size_t frames = 0;
  std::size_t frames_lost = 0;
  double tracking_p50_ms = 0.0;  ///< CPU time
  std::optional<TrajectoryAccuracy> accuracy = {};
  std::optional<VerdictSummary> verdicts = {};
};

struct SequenceRuns {
  std::string name;
  std::string folder;
  std::vector<MethodRun> methods;
  std::vector<MethodRun> variants;  ///< of method "full", with masks that are worse

  /// Both, the methods first.
  [[nodiscard]] std::vector<const MethodRun*> all() const;
};

/// All that `tsgctl report methods` found.
struct MethodsReport {
  std::string command;  ///< that makes it
  std::vector<std::string> methods;
  std::vector<std::string> variants;
  std::vector<std::string> variant_texts;  ///< what each is
  std::vector<SequenceRuns> sequences;

  /// "SEQUENCE, RUN: why", for each run that failed.
  [[nodiscard]] std::vector<std::string> problems() const;
};

/// By how much `run` is better than "none" on its sequence (eq. 12); nothing where one is missing.
[[nodiscard]] std::optional<double> ate_improvement(const SequenceRuns& sequence,
                                                    const MethodRun& run);
[[nodiscard]] std::optional<double> rpe_improvement(const SequenceRuns& sequence,
                                                    const MethodRun& run);

/// For people: methods.md.
[[nodiscard]] std::string to_markdown(const MethodsReport& report);

/// For programs: the keys are listed in docs/dynamic-features.md.
[[nodiscard]] nlohmann::json to_json(const MethodsReport& report);

}  // namespace tsg
