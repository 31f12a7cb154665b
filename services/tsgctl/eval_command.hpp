#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `eval ate|rpe GT EST` to tsgctl. Parsing the command carries it out and writes the result
/// to stdout; FatalError leaves App::parse() where that fails. Gives `eval`, for more to be added.
CLI::App& add_eval_command(CLI::App& app);

}  // namespace tsg
