#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "common/bus/bus_config.hpp"

namespace tsg {

/// Options of every command that joins the bus.
struct BusOptions {
  std::string config;
  std::vector<std::string> overrides;

  /// Section "bus" of what they name; throws FatalError (kConfig, kMissingInput).
  [[nodiscard]] BusConfig load() const;
};

void add_bus_options(CLI::App& command, BusOptions& options);

}  // namespace tsg
