#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/core/statistics.hpp"
#include "common/dataset/evaluation.hpp"

namespace tsg {

/// Which trajectories `tsgctl eval` compares, and how.
struct EvalInput {
  std::string truth;      ///< trajectory file or TUM folder
  std::string estimate;   ///< trajectory file
  std::string reference;  ///< another estimate to compare with (eq. 12); empty: none
  double max_difference_s = 0.02;
};

/// What `tsgctl eval ate` found.
struct AteReport {
  EvalInput input;
  std::size_t poses = 0;  ///< of the estimate
  Summary error_m;
  std::optional<Summary> reference_error_m;
};

/// What `tsgctl eval rpe` found.
struct RpeReport {
  EvalInput input;
  double delta = 1.0;
  DeltaUnit unit = DeltaUnit::kSeconds;
  RelativeError error;
  std::optional<RelativeError> reference_error;
};

/// For people: a table with a sentence above it.
[[nodiscard]] std::string to_text(const AteReport& report);
[[nodiscard]] std::string to_text(const RpeReport& report);

/// For programs: the keys are listed in docs/tsgctl.md.
[[nodiscard]] nlohmann::json to_json(const AteReport& report);
[[nodiscard]] nlohmann::json to_json(const RpeReport& report);

}  // namespace tsg
