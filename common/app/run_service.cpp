#include "common/app/run_service.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/app/stop_on_signal.hpp"
#include "common/app/systemd.hpp"
#include "common/core/error.hpp"

namespace tsg {
namespace {

/// Every top-level section of a configuration file; a service reads "bus" and its own.
const std::vector<std::string> kSections = {"bus", "camera", "segmentation", "slam", "map_server"};

struct Arguments {
  std::string config_path;
  std::vector<std::string> overrides;
  bool check_config = false;
  LogLevel log_level = LogLevel::kInfo;
};

void describe(CLI::App& app, Arguments& arguments) {
  static const std::map<std::string, LogLevel> kLevels = {{"debug", LogLevel::kDebug},
                                                          {"info", LogLevel::kInfo},
                                                          {"warn", LogLevel::kWarn},
                                                          {"error", LogLevel::kError}};
  app.add_option("--config", arguments.config_path, "YAML file; without it, the defaults");
  app.add_option("--set", arguments.overrides, "section.key=value, wins over the file; repeatable")
      ->take_all();
  app.add_flag("--check-config", arguments.check_config,
               "Only check the configuration: 0 if it is sound, 78 if not");
  app.add_option("--log-level", arguments.log_level, "debug, info, warn or error")
      ->transform(CLI::CheckedTransformer(kLevels, CLI::ignore_case));
  app.set_version_flag("--version", TSG_VERSION);
}

ConfigFile load_config(const Arguments& arguments) {
  ConfigFile file = arguments.config_path.empty()
                        ? ConfigFile::from_overrides(arguments.overrides)
                        : ConfigFile::load(arguments.config_path, arguments.overrides);
  const std::vector<std::string> unknown = file.unknown_sections(kSections);
  if (unknown.empty()) return file;
  std::string message = "the configuration has sections that no service reads:";
  for (const std::string& problem : unknown) message += "\n  " + problem;
  throw FatalError(ExitCode::kConfig, message);
}

void run_body(const Arguments& arguments,
              const ServiceInfo& info,
              const StopOnSignal& signals,
              const std::function<void(const ServiceContext&)>& body) {
  const ConfigFile config = load_config(arguments);
  Log log(info.name, arguments.log_level);
  SystemdNotifier systemd;
  const ServiceContext context{.config = config,
                               .log = log,
                               .stop = signals.token(),
                               .check_config_only = arguments.check_config,
                               .ready =
                                   [&] {
                                     SystemdNotifier::ready();
                                     log.info("ready");
                                   },
                               .heartbeat = [&] { systemd.heartbeat(); }};
  body(context);
  SystemdNotifier::stopping();
  if (arguments.check_config) std::cout << info.name << ": the configuration is sound\n";
}

int report(const ServiceInfo& info, ExitCode code, const char* message) {
  std::cerr << "tsg-" << info.name << ": error: " << message << std::endl;
  return static_cast<int>(code);
}

}  // namespace

int run_service(int argc,
                char** argv,
                const ServiceInfo& info,
                const std::function<void(const ServiceContext&)>& body) {
  CLI::App app(info.description, std::string("tsg-") + info.name);
  Arguments arguments;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  try {
    const StopOnSignal signals;
    run_body(arguments, info, signals, body);
    return static_cast<int>(ExitCode::kOk);
  } catch (const FatalError& error) {
    return report(info, error.code(), error.what());
  } catch (const std::exception& error) {
    return report(info, ExitCode::kFailure, error.what());
  }
}

}  // namespace tsg
