#pragma once

#include <cstdint>

namespace tsg {

/// What a service tells systemd, or whoever else set NOTIFY_SOCKET (sd_notify(3)); nothing where
/// nobody did.
class SystemdNotifier {
 public:
  SystemdNotifier();

  static void ready();
  static void stopping();
  /// Feeds the watchdog, at most four times in its period however often it is called.
  void heartbeat();

 private:
  std::int64_t heartbeat_period_ns_ = 0;  // 0: no watchdog
  std::int64_t last_heartbeat_ns_ = 0;
};

}  // namespace tsg
