#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `bench slam DIR` to tsgctl. Parsing the command carries it out and writes the figures to
/// stdout; FatalError leaves App::parse() where that fails.
void add_bench_command(CLI::App& app);

}  // namespace tsg
