#pragma once

#include <CLI/CLI.hpp>

namespace tsg {

/// `tsgctl model check`: whether a file is a network that segmentation can run.
void add_model_command(CLI::App& app);

}  // namespace tsg
