#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `tsgctl echo TOPIC`.
void add_echo_command(CLI::App& app);

}  // namespace tsg
