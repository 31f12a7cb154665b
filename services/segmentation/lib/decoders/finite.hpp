#pragma once

#include <span>

#include "common/core/error.hpp"

namespace tsg {

/// kInvalidNumber where an output of a network holds NaN or infinity.
[[nodiscard]] Expected<void> check_finite(std::span<const float> output);

}  // namespace tsg
