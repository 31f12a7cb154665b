#pragma once

#include <CLI/CLI.hpp>

namespace tsg {

/// Adds `tsgctl run`. Its callback throws FatalError with the code to end with.
void add_run_command(CLI::App& app);

}  // namespace tsg
