#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tsg {

enum class CheckLevel { kOk, kWarn, kFail };

/// What `tsgctl doctor` found out about one thing.
struct CheckResult {
  CheckLevel level = CheckLevel::kOk;
  std::string name;    ///< the thing: "shared memory"
  std::string detail;  ///< what is the case
  std::string fix;     ///< what to do about it; empty where nothing is to be done
};

[[nodiscard]] CheckResult passed(std::string name, std::string detail);
[[nodiscard]] CheckResult warned(std::string name, std::string detail, std::string fix);
[[nodiscard]] CheckResult failed(std::string name, std::string detail, std::string fix);

/// Aligned lines "ok    name  detail", the fix below those that need one.
[[nodiscard]] std::string checks_text(const std::vector<CheckResult>& results);
[[nodiscard]] nlohmann::json checks_json(const std::vector<CheckResult>& results);
[[nodiscard]] int failures_in(const std::vector<CheckResult>& results);

}  // namespace tsg
