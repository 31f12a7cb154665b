#pragma once

#include "services/tsgctl/lib/checks.hpp"

namespace tsg {

/// Sends a datagram to a multicast group on the loopback interface and looks whether it comes
/// back: how processes of this host find each other.
[[nodiscard]] CheckResult check_multicast();

}  // namespace tsg
