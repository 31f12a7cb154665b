#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <string>

#include "common/core/sample_window.hpp"

namespace tsg {

/// What became of the keyframes that slam sent.
struct KeyframeCounts {
  std::uint64_t integrated = 0;
  std::uint64_t rejected = 0;   ///< not sound; the log says why
  std::uint64_t missed = 0;     ///< lost in the bus as this service was too slow
  std::uint64_t discarded = 0;  ///< still waiting when the time to stop was over
  std::string last_rejection;

  /// Those of which nothing more can come.
  [[nodiscard]] std::uint64_t settled() const { return integrated + rejected + missed + discarded; }
};

/// Shared by the threads of the service: each counts what it does. Thread-safe.
class Progress {
 public:
  void add_integrated(double integration_ms);
  void add_rejected(const std::string& why);
  void add_discarded();
  /// `total` since the start; true where that is more than before.
  bool set_missed(std::uint64_t total);

  [[nodiscard]] KeyframeCounts counts() const;
  [[nodiscard]] Summary integration_ms() const;

  /// True once `keyframes` are settled; false where that takes longer than `timeout`, or on stop.
  bool wait_for_settled(std::uint64_t keyframes,
                        std::chrono::milliseconds timeout,
                        const std::stop_token& stop);

 private:
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable_any changed_;
  KeyframeCounts counts_;
  SampleWindow integration_ms_;
};

}  // namespace tsg
