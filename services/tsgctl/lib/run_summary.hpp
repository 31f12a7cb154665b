#pragma once

#include <string>

#include "services/tsgctl/lib/run_report.hpp"

namespace tsg {

/// What `tsgctl run` prints at its end: a screen of aligned lines.
[[nodiscard]] std::string summary_text(const RunReport& report);

}  // namespace tsg
