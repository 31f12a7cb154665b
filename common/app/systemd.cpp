#include "common/app/systemd.hpp"

#include <systemd/sd-daemon.h>

#include "common/core/time.hpp"

namespace tsg {

SystemdNotifier::SystemdNotifier() {
  std::uint64_t period_us = 0;
  if (sd_watchdog_enabled(0, &period_us) > 0) {
    heartbeat_period_ns_ = static_cast<std::int64_t>(period_us) * 1000 / 4;
  }
}

void SystemdNotifier::ready() { sd_notify(0, "READY=1"); }

void SystemdNotifier::stopping() { sd_notify(0, "STOPPING=1"); }

void SystemdNotifier::heartbeat() {
  if (heartbeat_period_ns_ == 0) return;
  const std::int64_t now_ns = monotonic_ns();
  if (now_ns - last_heartbeat_ns_ < heartbeat_period_ns_) return;
  last_heartbeat_ns_ = now_ns;
  sd_notify(0, "WATCHDOG=1");
}

}  // namespace tsg
