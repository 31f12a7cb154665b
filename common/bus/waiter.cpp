#include "common/bus/waiter.hpp"

#include <dds/dds.h>

#include <algorithm>

namespace tsg {

Waiter::Waiter(std::int32_t participant, std::int32_t condition)
    : stop_guard_(dds_create_guardcondition(participant), "a guard condition"),
      waitset_(dds_create_waitset(participant), "a waitset") {
  dds_waitset_attach(waitset_.handle(), stop_guard_.handle(), 0);
  if (condition != 0) dds_waitset_attach(waitset_.handle(), condition, 1);
}

WaitResult Waiter::wait_until(Clock::time_point deadline, const std::stop_token& stop) {
  dds_set_guardcondition(stop_guard_.handle(), false);
  // Runs at once where stop was requested already.
  const std::stop_callback wake(stop,
                                [this] { dds_set_guardcondition(stop_guard_.handle(), true); });
  const auto left = std::max(Clock::duration::zero(), deadline - Clock::now());
  const dds_duration_t timeout =
      deadline == Clock::time_point::max() ? DDS_INFINITY : std::chrono::nanoseconds(left).count();
  const dds_return_t triggered = dds_waitset_wait(waitset_.handle(), nullptr, 0, timeout);
  if (stop.stop_requested()) return WaitResult::kStopped;
  return triggered > 0 ? WaitResult::kTriggered : WaitResult::kTimeout;
}

Waiter::Clock::time_point Waiter::deadline_after(std::chrono::milliseconds timeout) {
  constexpr std::chrono::hours kForEver{24 * 365};
  return timeout >= kForEver ? Clock::time_point::max() : Clock::now() + timeout;
}

}  // namespace tsg
