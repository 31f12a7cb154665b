#include "services/tsgctl/echo_command.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>

#include "common/app/stop_on_signal.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/describe.hpp"
#include "services/tsgctl/bus_options.hpp"
#include "services/tsgctl/topic_list.hpp"
#include "services/tsgctl/topic_wait.hpp"

namespace tsg {
namespace {

struct EchoOptions {
  std::string topic;
  std::uint64_t count = 0;  ///< 0: until Ctrl-C
  double timeout_s = 0.0;   ///< 0: for ever
  BusOptions bus;
};

constexpr const char* kEchoFooter = R"(
Images and clouds are summarised, not dumped. Reading tsg/rgbd and its like takes part in shared
memory and costs the writer nothing.

Examples:
  tsgctl echo tsg/tracking_status
  tsgctl echo rt/tsg/pose -n 1
  tsgctl echo tsg/tracking_status | jq .inliers
  tsgctl echo rt/tsg/objects -n 1 --timeout 5   (exit code 75 if nothing comes in 5 s))";

template <typename Topic>
void echo(Bus& bus, const EchoOptions& options, const std::stop_token& stop) {
  Subscriber<Topic> samples(bus);
  TopicWait wait(options.topic, options.timeout_s);
  for (std::uint64_t shown = 0; options.count == 0 || shown < options.count;) {
    const auto sample = samples.take(stop, TopicWait::kStep);
    if (stop.stop_requested() || !std::cout) return;
    if (!sample) {
      wait.nothing_came(samples.publisher_count());
      continue;
    }
    wait.something_came();
    std::cout << to_json(**sample).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
              << std::endl;
    ++shown;
  }
}

void run(const EchoOptions& options) {
  const StopOnSignal signals;
  with_topic(options.topic, [&]<typename Topic>() {
    Bus bus(options.bus.load());
    echo<Topic>(bus, options, signals.token());
  });
}

}  // namespace

void add_echo_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("echo", "Print the messages of a topic as JSON lines");
  const auto options = std::make_shared<EchoOptions>();
  command.add_option("TOPIC", options->topic, "For example tsg/tracking_status")->required();
  command.add_option("-n,--count", options->count, "End after so many messages")
      ->type_name("N")
      ->check(CLI::PositiveNumber.description(""));
  command.add_option("--timeout", options->timeout_s, "End where nothing comes for so long")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber.description(""));
  add_bus_options(command, options->bus);
  command.footer(kEchoFooter);
  command.callback([options] { run(*options); });
}

}  // namespace tsg
