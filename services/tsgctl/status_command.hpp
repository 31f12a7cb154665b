#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `tsgctl status`.
void add_status_command(CLI::App& app);

}  // namespace tsg
