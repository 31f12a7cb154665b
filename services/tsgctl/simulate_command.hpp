#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `tsgctl simulate DIR`.
void add_simulate_command(CLI::App& app);

}  // namespace tsg
