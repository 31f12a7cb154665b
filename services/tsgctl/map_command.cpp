#include "services/tsgctl/map_command.hpp"

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "common/app/stop_on_signal.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/command.hpp"
#include "common/map_file/map_file.hpp"
#include "services/tsgctl/bus_options.hpp"
#include "services/tsgctl/lib/map_text.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

struct MapOptions {
  std::string file;
  bool localisation_only = false;
  bool json = false;
  double timeout_s = 60.0;  ///< the map of a building on a slow disk
  BusOptions bus;
};

constexpr const char* kMapFooter = R"(
Examples:
  tsgctl map save home.tsgmap
  tsgctl map info home.tsgmap
  tsgctl map info home.tsgmap --json | jq .keyframes
  tsgctl map load home.tsgmap --localisation-only
A map to start in: slam.map.load, or tsgctl run --load-map (docs/maps.md).
Ends with 65 where a map file is damaged or newer than this program, 66 where it is not there, 73
where it cannot be written, 75 where slam does not answer.)";

/// The answer of slam, which may run in another folder: paths go out absolute.
nlohmann::json ask_slam(const MapOptions& options,
                        const std::string& verb,
                        nlohmann::json request) {
  const StopOnSignal signals;
  if (!options.file.empty()) request["file"] = std::filesystem::absolute(options.file).string();
  BusConfig config = options.bus.load();
  config.use_shared_memory = false;  // commands come without
  Bus bus(config);
  CommandClient client(bus);
  const auto timeout = std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::duration<double>(options.timeout_s));
  const std::string reply =
      value_or_throw(client.call("slam", verb, request.dump(), timeout, signals.token()));
  return nlohmann::json::parse(reply, nullptr, /*allow_exceptions=*/false);
}

void save(const MapOptions& options) {
  const nlohmann::json reply = ask_slam(options, "save_map", nlohmann::json::object());
  if (options.json) {
    std::cout << reply.dump(2) << std::endl;
    return;
  }
  std::cout << "saved " << reply.value("keyframes", 0) << " keyframes, " << reply.value("points", 0)
            << " points, " << format_bytes(reply.value("bytes", std::uint64_t{0})) << ": "
            << reply.value("file", "") << std::endl;
}

void load(const MapOptions& options) {
  nlohmann::json request = nlohmann::json::object();
  if (options.localisation_only) request["localisation_only"] = true;
  const nlohmann::json reply = ask_slam(options, "load_map", request);
  if (options.json) {
    std::cout << reply.dump(2) << std::endl;
    return;
  }
  std::cout << "slam looks for its place in " << reply.value("loaded_from", "") << ": "
            << reply.value("keyframes", 0) << " keyframes, " << reply.value("points", 0)
            << " points"
            << (reply.value("localisation_only", false) ? "; localisation only"
                                                        : "; it goes on mapping")
            << std::endl;
}

void tell_of_file(const MapOptions& options) {
  const MapFile file = value_or_throw(read_map_file(options.file));
  const MapFileReport report{options.file, file.bytes.size(), file.version, file.info};
  std::cout << (options.json ? to_json(report).dump(2) + "\n" : to_text(report));
}

/// Of the map that slam works on.
void tell_of_slam(const MapOptions& options) {
  const nlohmann::json reply = ask_slam(options, "map_info", nlohmann::json::object());
  if (options.json) {
    std::cout << reply.dump(2) << std::endl;
    return;
  }
  const std::string file = reply.value("loaded_from", "");
  std::cout << "slam's map\n"
            << format_table({{"keyframes", std::to_string(reply.value("keyframes", 0))},
                             {"points", std::to_string(reply.value("points", 0))},
                             {"camera", reply.value("camera", "unknown until the first frame")},
                             {"began as", file.empty() ? "a new map" : file},
                             {"grows", reply.value("localisation_only", false) ? "no" : "yes"},
                             {"tracking", reply.value("state", "?")}},
                            2);
}

void tell(const MapOptions& options) {
  if (options.file.empty()) {
    tell_of_slam(options);
  } else {
    tell_of_file(options);
  }
}

CLI::App& add(CLI::App& map,
              const std::string& name,
              const std::string& what,
              const std::shared_ptr<MapOptions>& options) {
  CLI::App& command = *map.add_subcommand(name, what);
  command.add_flag("--json", options->json, "For scripts");
  command.add_option("--timeout", options->timeout_s, "How long slam may take")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber.description(""))
      ->capture_default_str();
  add_bus_options(command, options->bus);
  command.footer(kMapFooter);
  return command;
}

}  // namespace

void add_map_command(CLI::App& app) {
  CLI::App& map = *app.add_subcommand("map", "Save, load and examine maps of slam");
  map.footer(kMapFooter);
  map.require_subcommand(1);
  const auto options = std::make_shared<MapOptions>();
  CLI::App& saving = add(map, "save", "Write the map of the running slam into a file", options);
  saving.add_option("FILE", options->file, "Replaced only once the new one is complete")
      ->required();
  saving.callback([options] { save(*options); });
  CLI::App& loading =
      add(map, "load", "Let the running slam change over to the map of a file", options);
  loading.add_option("FILE", options->file, "A file of 'tsgctl map save'")->required();
  loading.add_flag("--localisation-only", options->localisation_only,
                   "Find poses in the map, never change it");
  loading.callback([options] { load(*options); });
  CLI::App& telling = add(map, "info", "Tell what is in a map file, or in slam's map", options);
  telling.add_option("FILE", options->file, "Without it: the map of the running slam");
  telling.callback([options] { tell(*options); });
}

}  // namespace tsg
