#pragma once

#include "common/core/error.hpp"

namespace tsg {

/// Where RouDi, the owner of the shared memory, listens; fixed by iceoryx.
inline constexpr const char* kRoudiSocket = "/tmp/roudi";

/// Whether RouDi answers; kUnavailable with the way to start it where it does not. Must come
/// before any participant: without RouDi that blocks for a minute, deaf to SIGTERM, and aborts.
[[nodiscard]] Expected<void> check_roudi();

}  // namespace tsg
