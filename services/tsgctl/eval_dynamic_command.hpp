#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `dynamic DIR` to `tsgctl eval`. Parsing the command carries it out and writes the figures
/// to stdout; FatalError leaves App::parse() where that fails.
void add_eval_dynamic_command(CLI::App& eval);

}  // namespace tsg
