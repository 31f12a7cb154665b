#pragma once

#include <cstdint>
#include <vector>

#include "services/tsgctl/lib/checks.hpp"

namespace tsg {

/// What the host gives: shared memory, a RouDi that answers and its segments, multicast on the
/// loopback interface.
[[nodiscard]] std::vector<CheckResult> check_host();

/// Bytes of /dev/shm that RouDi takes with the shipped pools.
[[nodiscard]] std::uint64_t needed_shared_memory_bytes();

/// The verdict on a /dev/shm of that size; `roudi_has_its_share`: a running RouDi has taken what
/// it needs already. Pure, for the test.
[[nodiscard]] CheckResult judge_shared_memory(std::uint64_t total_bytes,
                                              std::uint64_t available_bytes,
                                              bool roudi_has_its_share);

}  // namespace tsg
