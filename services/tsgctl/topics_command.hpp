#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `tsgctl topics`.
void add_topics_command(CLI::App& app);

}  // namespace tsg
