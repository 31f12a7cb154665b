#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "services/tsgctl/lib/tracking_log.hpp"

namespace tsg {

/// One sample of a topic as `tsgctl hz` saw it; all times CLOCK_MONOTONIC of this host.
struct Arrival {
  std::int64_t received_ns = 0;
  /// Nothing for messages without our header.
  std::optional<std::int64_t> published_ns = std::nullopt;
  std::optional<std::uint64_t> seq = std::nullopt;
};

/// The last samples in figures.
struct RateSummary {
  std::size_t samples = 0;  ///< that the figures are about
  double rate_hz = 0.0;     ///< mean; the fields below are zero where there are fewer than two
  double slowest_hz = 0.0;  ///< of the longest gap between two samples
  double fastest_hz = 0.0;
  double jitter_ms = 0.0;  ///< standard deviation of the time between samples
  std::optional<Percentiles> latency_ms = std::nullopt;  ///< published to received
  std::uint64_t missed = 0;                              ///< holes in seq since the first sample
};

/// Measures the rate of a topic over a sliding window.
class RateMeter {
 public:
  /// `window`: samples that the figures are about, at least 2.
  explicit RateMeter(std::size_t window) : window_(window) {}

  void add(const Arrival& arrival);
  [[nodiscard]] RateSummary summary() const;

 private:
  std::size_t window_;
  std::deque<Arrival> arrivals_;
  std::optional<std::uint64_t> last_seq_;
  std::uint64_t missed_ = 0;
};

/// "29.98 Hz  min 28.1  max 31.9  jitter 0.4 ms  latency 0.11/0.20 ms (p50/p99)  missed 0  (30)".
[[nodiscard]] std::string rate_text(const RateSummary& summary);

}  // namespace tsg
