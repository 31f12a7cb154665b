#include "services/tsgctl/topics_command.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/app/stop_on_signal.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/discovery.hpp"
#include "services/tsgctl/bus_options.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

constexpr std::chrono::milliseconds kDiscoveryTime{1000};

struct TopicsOptions {
  bool json = false;
  BusOptions bus;
};

constexpr const char* kTopicsFooter = R"(
Examples:
  tsgctl topics
  tsgctl topics --json | jq '.[] | select(.domain_id == 10)')";

const char* to_string(Transport transport) {
  switch (transport) {
    case Transport::kSharedMemory:
      return "SHM";
    case Transport::kUdp:
      return "UDP";
    case Transport::kUnknown:
      break;
  }
  return "?";
}

/// "tsg-slam[4711] SHM"
std::string peers_text(const std::vector<Peer>& peers) {
  std::string text;
  for (const Peer& peer : peers) {
    if (!text.empty()) text += ", ";
    text += (peer.process.empty() ? "?" : peer.process) + "[" + std::to_string(peer.pid) + "] " +
            to_string(peer.transport);
  }
  return text.empty() ? "-" : text;
}

nlohmann::json peers_json(const std::vector<Peer>& peers) {
  nlohmann::json json = nlohmann::json::array();
  for (const Peer& peer : peers) {
    json.push_back({{"host", peer.host},
                    {"process", peer.process},
                    {"pid", peer.pid},
                    {"transport", to_string(peer.transport)}});
  }
  return json;
}

void print_json(const std::vector<TopicInfo>& topics) {
  nlohmann::json json = nlohmann::json::array();
  for (const TopicInfo& topic : topics) {
    json.push_back({{"name", topic.name},
                    {"type", topic.type},
                    {"domain_id", topic.domain_id},
                    {"writers", peers_json(topic.writers)},
                    {"readers", peers_json(topic.readers)}});
  }
  using Handler = nlohmann::json::error_handler_t;
  std::cout << json.dump(2, ' ', false, Handler::replace) << std::endl;
}

void print_table(const std::vector<TopicInfo>& topics) {
  std::vector<std::vector<std::string>> rows{{"TOPIC", "DOMAIN", "TYPE", "WRITERS", "READERS"}};
  for (const TopicInfo& topic : topics) {
    rows.push_back({topic.name, std::to_string(topic.domain_id), topic.type,
                    peers_text(topic.writers), peers_text(topic.readers)});
  }
  std::cout << format_table(rows);
}

void run(const TopicsOptions& options) {
  const StopOnSignal signals;
  BusConfig config = options.bus.load();
  // Discovery goes over the network in either domain; so RouDi may be down, or need not know us.
  config.use_shared_memory = false;
  Bus bus(config);
  const auto topics = discover_topics(bus, kDiscoveryTime, signals.token());
  if (options.json) return print_json(topics);
  if (topics.empty()) {
    throw FatalError(ExitCode::kUnavailable,
                     "nobody writes or reads anything in the domains " +
                         std::to_string(config.standard_domain) + " and " +
                         std::to_string(config.shared_memory_domain) +
                         "; start the system: tsgctl run --input DIR --out OUT");
  }
  print_table(topics);
}

}  // namespace

void add_topics_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("topics", "List topics with their types, writers and readers");
  const auto options = std::make_shared<TopicsOptions>();
  command.add_flag("--json", options->json, "For scripts");
  add_bus_options(command, options->bus);
  command.footer(kTopicsFooter);
  command.callback([options] { run(*options); });
}

}  // namespace tsg
