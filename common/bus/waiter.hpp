#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>

#include "common/bus/dds_entity.hpp"

namespace tsg {

enum class WaitResult { kTriggered, kTimeout, kStopped };

/// Waits for one DDS condition or a stop token, whichever comes first, without polling. One thread
/// waits at a time.
class Waiter {
 public:
  using Clock = std::chrono::steady_clock;

  /// `condition` is a condition, or an entity whose status mask is set; 0 waits for stop only.
  Waiter(std::int32_t participant, std::int32_t condition);

  WaitResult wait_until(Clock::time_point deadline, const std::stop_token& stop);

  /// now + timeout, without overflow for "for ever".
  [[nodiscard]] static Clock::time_point deadline_after(std::chrono::milliseconds timeout);

 private:
  DdsEntity stop_guard_;
  DdsEntity waitset_;
};

}  // namespace tsg
