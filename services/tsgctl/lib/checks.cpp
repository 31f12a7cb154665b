#include "services/tsgctl/lib/checks.hpp"

#include <algorithm>
#include <utility>

#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

std::string to_string(CheckLevel level) {
  switch (level) {
    case CheckLevel::kOk:
      return "ok";
    case CheckLevel::kWarn:
      return "warn";
    case CheckLevel::kFail:
      break;
  }
  return "FAIL";
}

}  // namespace

CheckResult passed(std::string name, std::string detail) {
  return {CheckLevel::kOk, std::move(name), std::move(detail), ""};
}

CheckResult warned(std::string name, std::string detail, std::string fix) {
  return {CheckLevel::kWarn, std::move(name), std::move(detail), std::move(fix)};
}

CheckResult failed(std::string name, std::string detail, std::string fix) {
  return {CheckLevel::kFail, std::move(name), std::move(detail), std::move(fix)};
}

std::string checks_text(const std::vector<CheckResult>& results) {
  std::vector<std::vector<std::string>> rows;
  for (const CheckResult& result : results) {
    rows.push_back({to_string(result.level), result.name, result.detail});
    if (!result.fix.empty()) rows.push_back({"", "", "-> " + result.fix});
  }
  return format_table(rows);
}

nlohmann::json checks_json(const std::vector<CheckResult>& results) {
  nlohmann::json checks = nlohmann::json::array();
  for (const CheckResult& result : results) {
    checks.push_back({{"level", to_string(result.level)},
                      {"name", result.name},
                      {"detail", result.detail},
                      {"fix", result.fix}});
  }
  return {{"failures", failures_in(results)}, {"checks", std::move(checks)}};
}

int failures_in(const std::vector<CheckResult>& results) {
  return static_cast<int>(std::count_if(results.begin(), results.end(), [](const auto& result) {
    return result.level == CheckLevel::kFail;
  }));
}

}  // namespace tsg
