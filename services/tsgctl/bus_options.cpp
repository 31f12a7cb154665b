#include "services/tsgctl/bus_options.hpp"

#include "common/app/config_file.hpp"
#include "common/bus/bus_config_file.hpp"

namespace tsg {

BusConfig BusOptions::load() const {
  return load_bus_config(config.empty() ? ConfigFile::from_overrides(overrides)
                                        : ConfigFile::load(config, overrides));
}

void add_bus_options(CLI::App& command, BusOptions& options) {
  command.add_option("--config", options.config, "YAML file; without it, the defaults")
      ->type_name("FILE");
  command
      .add_option("--set", options.overrides, "section.key=value, wins over the file; repeatable")
      ->take_all()
      ->type_name("SECTION.KEY=VALUE");
}

}  // namespace tsg
