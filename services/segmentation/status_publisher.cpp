#include "services/segmentation/status_publisher.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "common/core/time.hpp"

namespace tsg {

std::string with_one_decimal(double value) {
  std::array<char, 32> text{};
  const int length = std::snprintf(text.data(), text.size(), "%.1f", value);
  return {text.data(), static_cast<std::size_t>(length)};
}

StatusPublisher::StatusPublisher(Bus& bus, const Log& log, const std::string& service)
    : log_(log), diagnostics_(bus, service), reported_at_ns_(monotonic_ns()) {}

void StatusPublisher::publish(const SegmentationCounters& counters,
                              const std::string& provider,
                              std::uint64_t passed_over,
                              const ProviderState& state) {
  log_change(state.problem);
  const std::int64_t now_ns = monotonic_ns();
  const double elapsed_s = to_seconds(now_ns - std::exchange(reported_at_ns_, now_ns));
  const std::uint64_t frames = counters.frames - std::exchange(reported_frames_, counters.frames);
  const std::uint64_t failed = counters.failed - std::exchange(reported_failed_, counters.failed);
  const Summary inference = counters.total_ms.summary();
  const Summary latency = counters.latency_ms.summary();

  Diagnostic diagnostic;
  const bool is_sound = failed == 0 && state.problem.empty();
  diagnostic.level = is_sound ? DiagnosticLevel::kOk : DiagnosticLevel::kWarn;
  diagnostic.message = failed > 0               ? "masks withheld: " + counters.last_failure
                       : !state.problem.empty() ? state.problem
                       : frames > 0             ? "segmenting"
                                                : "waiting for frames";
  const double rate_hz = elapsed_s > 0.0 ? static_cast<double>(frames) / elapsed_s : 0.0;
  diagnostic.values = {{"provider", provider},
                       {"rate_hz", with_one_decimal(rate_hz)},
                       {"frames", std::to_string(counters.frames)},
                       {"passed_over", std::to_string(passed_over)},
                       {"backlog", std::to_string(counters.backlog())},
                       {"failed", std::to_string(counters.failed)},
                       {"inference_p50_ms", with_one_decimal(inference.median)},
                       {"inference_p99_ms", with_one_decimal(inference.p99)},
                       {"latency_p50_ms", with_one_decimal(latency.median)},
                       {"latency_p99_ms", with_one_decimal(latency.p99)}};
  diagnostic.values.insert(diagnostic.values.end(), state.values.begin(), state.values.end());
  if (const auto published = diagnostics_.publish(diagnostic); !published) {
    log_.warn("diagnostics not published", {{"why", published.error().message}});
  }
}

void StatusPublisher::log_change(const std::string& problem) {
  if (problem == problem_) return;
  if (problem.empty()) {
    log_.info("as configured again");
  } else {
    log_.warn("not as configured", {{"why", problem}});
  }
  problem_ = problem;
}

}  // namespace tsg
