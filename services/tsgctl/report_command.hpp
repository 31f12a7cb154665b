#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `report methods DIR...` to tsgctl. Parsing the command carries it out; FatalError leaves
/// App::parse() where something failed, after all else was done.
void add_report_command(CLI::App& app);

}  // namespace tsg
