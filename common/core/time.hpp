#pragma once

#include <chrono>
#include <cstdint>
#include <utility>

namespace tsg {

/// CLOCK_MONOTONIC in nanoseconds: comparable between processes of one host.
[[nodiscard]] inline std::int64_t monotonic_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// The present in nanoseconds since 1970, UTC.
[[nodiscard]] inline std::int64_t utc_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

[[nodiscard]] inline double to_seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }
[[nodiscard]] inline double to_milliseconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

/// Measures wall-clock time since its making or the last lap.
class Stopwatch {
 public:
  /// Nanoseconds since the last lap; starts the next one.
  std::int64_t lap_ns() {
    const std::int64_t now = monotonic_ns();
    return now - std::exchange(start_ns_, now);
  }

 private:
  std::int64_t start_ns_ = monotonic_ns();
};

}  // namespace tsg
