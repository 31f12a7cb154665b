#pragma once

#include <CLI/CLI.hpp>

namespace tsg {

/// `tsgctl map save|load|info`: maps of slam in files.
void add_map_command(CLI::App& app);

}  // namespace tsg
