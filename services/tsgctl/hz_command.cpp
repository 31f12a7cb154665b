#include "services/tsgctl/hz_command.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>

#include "common/app/stop_on_signal.hpp"
#include "common/bus/bus.hpp"
#include "common/core/time.hpp"
#include "services/tsgctl/bus_options.hpp"
#include "services/tsgctl/lib/rate_meter.hpp"
#include "services/tsgctl/topic_list.hpp"
#include "services/tsgctl/topic_wait.hpp"

namespace tsg {
namespace {

struct HzOptions {
  std::string topic;
  std::size_t window = 100;
  std::uint64_t reports = 0;  ///< 0: until Ctrl-C
  double timeout_s = 0.0;     ///< 0: for ever
  BusOptions bus;
};

constexpr const char* kHzFooter = R"(
A line a second: mean rate, slowest and fastest, jitter, latency from publishing to here, holes in
the sequence numbers.

Examples:
  tsgctl hz tsg/rgbd
  tsgctl hz rt/tsg/pose --window 300
  tsgctl hz tsg/instances -n 5 --timeout 10)";

template <typename Message>
Arrival arrival_of(const Message& message) {
  Arrival arrival{.received_ns = monotonic_ns()};
  if constexpr (requires { message.header.publish_monotonic_ns; }) {
    arrival.published_ns = message.header.publish_monotonic_ns;
    arrival.seq = message.header.seq;
  }
  return arrival;
}

template <typename Topic>
void measure(Bus& bus, const HzOptions& options, const std::stop_token& stop) {
  constexpr std::int64_t kReportPeriodNs = 1'000'000'000;
  Subscriber<Topic> samples(bus);
  RateMeter meter(options.window);
  TopicWait wait(options.topic, options.timeout_s);
  std::int64_t reported_ns = monotonic_ns();
  for (std::uint64_t reports = 0; options.reports == 0 || reports < options.reports;) {
    if (const auto sample = samples.take(stop, TopicWait::kStep)) {
      meter.add(arrival_of(**sample));
      wait.something_came();
    } else {
      wait.nothing_came(samples.publisher_count());
    }
    if (stop.stop_requested() || !std::cout) return;
    const RateSummary summary = meter.summary();
    if (summary.samples < 2 || monotonic_ns() - reported_ns < kReportPeriodNs) continue;
    reported_ns = monotonic_ns();
    ++reports;
    std::cout << rate_text(summary) << std::endl;
  }
}

void run(const HzOptions& options) {
  const StopOnSignal signals;
  with_topic(options.topic, [&]<typename Topic>() {
    Bus bus(options.bus.load());
    measure<Topic>(bus, options, signals.token());
  });
}

}  // namespace

void add_hz_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("hz", "Measure rate, jitter and latency of a topic");
  const auto options = std::make_shared<HzOptions>();
  command.add_option("TOPIC", options->topic, "For example tsg/rgbd")->required();
  command.add_option("--window", options->window, "Messages that the figures are about (100)")
      ->type_name("N")
      ->check(CLI::Range(2, 100'000).description(""));
  command.add_option("-n,--count", options->reports, "End after so many lines")
      ->type_name("N")
      ->check(CLI::PositiveNumber.description(""));
  command.add_option("--timeout", options->timeout_s, "End where nothing comes for so long")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber.description(""));
  add_bus_options(command, options->bus);
  command.footer(kHzFooter);
  command.callback([options] { run(*options); });
}

}  // namespace tsg
