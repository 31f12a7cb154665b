#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `eval-tum [NAME...]` to tsgctl. Parsing the command carries it out and writes the tables to
/// stdout; FatalError leaves App::parse() where that fails.
void add_eval_tum_command(CLI::App& app);

}  // namespace tsg
