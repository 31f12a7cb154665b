#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "services/tsgctl/map_eval/map_evaluation.hpp"

namespace tsg {

/// Tables for people to read.
[[nodiscard]] std::string to_text(const MapEvalReport& report);
/// The same figures; what is not known is null.
[[nodiscard]] nlohmann::json to_json(const MapEvalReport& report);

}  // namespace tsg
