#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `tsgctl hz TOPIC`.
void add_hz_command(CLI::App& app);

}  // namespace tsg
