#pragma once

#include <CLI/App.hpp>

namespace tsg {

/// Adds `tsgctl doctor`.
void add_doctor_command(CLI::App& app);

}  // namespace tsg
