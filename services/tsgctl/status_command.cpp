#include "services/tsgctl/status_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "common/app/stop_on_signal.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/diagnostics.hpp"
#include "services/tsgctl/bus_options.hpp"
#include "services/tsgctl/lib/service_health.hpp"

namespace tsg {
namespace {

/// Services report once a second: who is silent for longer than this is not there.
constexpr std::chrono::milliseconds kListeningTime{2500};

struct StatusOptions {
  bool json = false;
  BusOptions bus;
};

constexpr const char* kStatusFooter = R"(
Listens to rt/diagnostics for up to 2.5 s. Ends with 0 when all four services are well, 69 when
none runs, 1 otherwise.

Examples:
  tsgctl status
  tsgctl status --json | jq .slam.values)";

HealthState to_state(DiagnosticLevel level) {
  switch (level) {
    case DiagnosticLevel::kOk:
      return HealthState::kOk;
    case DiagnosticLevel::kWarn:
      return HealthState::kWarn;
    default:
      return HealthState::kError;
  }
}

void note(const NamedDiagnostic& heard, std::vector<ServiceHealth>& services) {
  const auto found = std::find_if(services.begin(), services.end(),
                                  [&](const auto& health) { return health.service == heard.name; });
  if (found == services.end()) return;  // somebody else's: anybody may use rt/diagnostics
  found->state = to_state(heard.diagnostic.level);
  found->message = heard.diagnostic.message;
  found->values = {heard.diagnostic.values.begin(), heard.diagnostic.values.end()};
}

bool all_heard(const std::vector<ServiceHealth>& services) {
  return std::none_of(services.begin(), services.end(), [](const ServiceHealth& health) {
    return health.state == HealthState::kSilent;
  });
}

std::vector<ServiceHealth> listen(Bus& bus, const std::stop_token& stop) {
  std::vector<ServiceHealth> services;
  for (const std::string& name : service_names()) {
    services.push_back({name, HealthState::kSilent, "says nothing", {}});
  }
  Subscriber<topics::Diagnostics> diagnostics(bus);
  const auto deadline = std::chrono::steady_clock::now() + kListeningTime;
  while (!all_heard(services) && std::chrono::steady_clock::now() < deadline) {
    const auto message = diagnostics.take(stop, std::chrono::milliseconds(100));
    if (stop.stop_requested()) break;
    if (!message) continue;
    for (const NamedDiagnostic& heard : to_diagnostics(**message)) note(heard, services);
  }
  return services;
}

void run(const StatusOptions& options) {
  const StopOnSignal signals;
  BusConfig config = options.bus.load();
  config.use_shared_memory = false;  // diagnostics come without; RouDi may be what is down
  Bus bus(config);
  const std::vector<ServiceHealth> services = listen(bus, signals.token());
  if (options.json) std::cout << health_json(services).dump(2) << std::endl;
  if (all_silent(services)) {
    throw FatalError(ExitCode::kUnavailable,
                     "no service runs; start the system with 'tsgctl run --input DIR --out OUT'");
  }
  if (!options.json) std::cout << health_text(services);
  const std::string unhealthy = unhealthy_names(services);
  if (unhealthy.empty()) return;
  throw FatalError(ExitCode::kFailure, "not well or not running: " + unhealthy +
                                           "; their logs tell why (OUT/logs, or journalctl)");
}

}  // namespace

void add_status_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("status", "Tell which services run and how they are");
  const auto options = std::make_shared<StatusOptions>();
  command.add_flag("--json", options->json, "For scripts, with every figure");
  add_bus_options(command, options->bus);
  command.footer(kStatusFooter);
  command.callback([options] { run(*options); });
}

}  // namespace tsg
