#include "common/bus/bus_config_file.hpp"

namespace tsg {

BusConfig load_bus_config(const ConfigFile& file) {
  BusConfig config;
  ConfigReader reader(file, "bus");
  reader.read("standard_domain", config.standard_domain);
  reader.read("shared_memory_domain", config.shared_memory_domain);
  reader.read("interface", config.interface);
  reader.read("use_shared_memory", config.use_shared_memory);
  reader.finish(config.problems());
  return config;
}

}  // namespace tsg
