#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `map DIR` to `tsgctl eval`. Parsing the command carries it out and writes the figures to
/// stdout; FatalError leaves App::parse() where that fails.
void add_eval_map_command(CLI::App& eval);

}  // namespace tsg
