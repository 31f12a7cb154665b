#pragma once

#include <functional>
#include <stop_token>

#include "common/app/config_file.hpp"
#include "common/app/log.hpp"

namespace tsg {

/// What a service's body gets.
struct ServiceContext {
  const ConfigFile& config;
  Log log;
  std::stop_token stop;    ///< requested by SIGTERM or SIGINT
  bool check_config_only;  ///< --check-config: load the configuration, then return
  /// Call once when the service works: tells systemd (READY=1) and logs it.
  std::function<void()> ready;
  /// Call from the main loop at least once a second: feeds systemd's watchdog where there is one.
  std::function<void()> heartbeat;
};

struct ServiceInfo {
  const char* name;         ///< also its section of the configuration, e.g. "slam"
  const char* description;  ///< a sentence for --help
};

/// The frame of every service: parses arguments (--config FILE, --set section.key=value,
/// --check-config, --log-level, --version), loads the configuration, turns signals into `stop`,
/// talks to systemd, and turns FatalError into a message and its exit code, which it returns.
int run_service(int argc,
                char** argv,
                const ServiceInfo& info,
                const std::function<void(const ServiceContext&)>& body);

}  // namespace tsg
