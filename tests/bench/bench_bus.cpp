// Hand-over of a VGA image with depth (1.5 MB) between two processes at 30 Hz: without a copy,
// with a copy out of shared memory, and over UDP on the loopback interface, in one run.
//   tests/support/own_host build/release/bin/bench_bus
// The time of an iteration is what the reading process measured, from publish() to the images.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string_view>
#include <thread>

#include "common/core/statistics.hpp"
#include "common/core/time.hpp"
#include "tests/bench/hand_over.hpp"
#include "tests/support/running_roudi.hpp"

namespace tsg::bench {
namespace {

using namespace std::chrono_literals;

constexpr int kFrames = 300;
constexpr auto kPeriod = std::chrono::nanoseconds(1'000'000'000 / 30);

/// Median latency of each finished benchmark, for the ratios in the end.
std::map<std::string, double>& medians_ms() {
  static std::map<std::string, double> medians;
  return medians;
}

/// What a camera does: writes new images, then stamps and hands them over.
template <typename Topic>
bool publish_frame(Publisher<Topic>& publisher, std::uint64_t seq) {
  auto loan = publisher.loan();
  if (!loan) return false;
  auto& message = **loan;
  const auto value = static_cast<std::uint8_t>(seq);
  std::fill_n(message.colour, 3 * kPixels, value);
  std::fill_n(message.depth, kPixels, std::uint16_t{value});
  message.header.seq = seq;
  message.header.publish_monotonic_ns = monotonic_ns();
  return publisher.publish(std::move(*loan)).has_value();
}

struct Results {
  std::vector<double> latencies_ms;
  int in_shared_segment = 0;
  int lost = 0;
  bool all_intact = true;

  void add(const std::optional<Receipt>& receipt, std::uint64_t seq) {
    if (!receipt || receipt->seq != seq) {
      ++lost;
      return;
    }
    latencies_ms.push_back(to_milliseconds(receipt->latency_ns));
    in_shared_segment += receipt->in_shared_segment ? 1 : 0;
    all_intact = all_intact && receipt->is_intact;
  }

  void report(benchmark::State& state) const {
    const Summary summary = summarise(latencies_ms);
    state.counters["p50_ms"] = summary.median;
    state.counters["p99_ms"] = summary.p99;
    state.counters["max_ms"] = summary.max;
    state.counters["in_shm"] = in_shared_segment;
    state.counters["copied"] = static_cast<double>(latencies_ms.size()) - in_shared_segment;
    state.counters["lost"] = lost;
    if (!all_intact) state.SkipWithError("the reader saw images that were not sent");
  }
};

template <typename Topic>
void hand_over(benchmark::State& state, const std::string& name, Way way) {
  Bus bus(bus_config(way));
  Publisher<Topic> publisher(bus);
  const ReaderProcess reader(Topic::kName, way);
  if (!publisher.wait_for_subscribers(1, 10s)) {
    state.SkipWithError("the reading process does not come up");
    return;
  }
  Results results;
  std::uint64_t seq = 0;
  auto next = std::chrono::steady_clock::now();
  for (auto unused : state) {
    std::this_thread::sleep_until(next += kPeriod);
    if (!publish_frame(publisher, ++seq)) {
      state.SkipWithError("cannot publish");
      break;
    }
    const auto receipt = reader.wait_for_receipt();
    results.add(receipt, seq);
    state.SetIterationTime(receipt ? to_seconds(receipt->latency_ns) : 0.0);
  }
  results.report(state);
  medians_ms()[name] = summarise(results.latencies_ms).median;
}

template <typename Topic>
void add_benchmark(const std::string& name, Way way) {
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): the library owns its benchmarks
  benchmark::RegisterBenchmark(
      name.c_str(), [name, way](benchmark::State& state) { hand_over<Topic>(state, name, way); })
      ->Iterations(kFrames)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void print_ratios() {
  const auto reference = medians_ms().find("zero_copy/service_frame");
  if (reference == medians_ms().end() || reference->second <= 0.0) return;
  for (const auto& [name, median_ms] : medians_ms()) {
    std::printf("%-32s median %7.3f ms = %5.1f x zero copy\n", name.c_str(), median_ms,
                median_ms / reference->second);
  }
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return static_cast<int>(ExitCode::kUsage);
  test::RunningRoudi::instance();
  add_benchmark<ServiceFrame>("zero_copy/service_frame", Way::kZeroCopy);
  add_benchmark<VgaFrame>("zero_copy/vga_frame", Way::kZeroCopy);
  add_benchmark<ServiceFrame>("copying_take/service_frame", Way::kSharedMemoryThenCopy);
  add_benchmark<VgaFrame>("copying_take/vga_frame", Way::kSharedMemoryThenCopy);
  add_benchmark<ServiceFrame>("udp/service_frame", Way::kUdp);
  add_benchmark<VgaFrame>("udp/vga_frame", Way::kUdp);  // the fair one: no spare bytes sent
  benchmark::RunSpecifiedBenchmarks();
  print_ratios();
  return 0;
}

}  // namespace
}  // namespace tsg::bench

int main(int argc, char** argv) {
  try {
    if (argc == 5 && std::string_view(argv[1]) == "--reader") {
      return tsg::bench::run_reader(argv[2], static_cast<tsg::bench::Way>(std::stoi(argv[3])),
                                    argv[4]);
    }
    return tsg::bench::run(argc, argv);
  } catch (const tsg::FatalError& error) {
    std::fprintf(stderr, "bench_bus: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
