#pragma once

#include <vector>

#include "services/tsgctl/lib/checks.hpp"

namespace tsg {

/// Programs and libraries that a run uses: our services, RouDi, gnuplot, ONNX Runtime.
[[nodiscard]] std::vector<CheckResult> check_programs();

}  // namespace tsg
