#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `tsgctl simulate SCENE --out DIR`.
void add_simulate_command(CLI::App& app);

}  // namespace tsg
