#pragma once

#include "common/app/config_file.hpp"
#include "common/bus/bus_config.hpp"

namespace tsg {

/// Reads section "bus"; throws FatalError (kConfig) listing all that is wrong with it.
[[nodiscard]] BusConfig load_bus_config(const ConfigFile& file);

}  // namespace tsg
