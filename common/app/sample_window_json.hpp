#pragma once

#include <nlohmann/json_fwd.hpp>

#include "common/core/sample_window.hpp"

namespace tsg {

/// What reports tell of measured values: {"count": N, "p50": X, "p99": X, "max": X}.
[[nodiscard]] nlohmann::json to_json(const SampleWindow& window);

}  // namespace tsg
