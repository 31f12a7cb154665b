#pragma once

#include <cstdint>

namespace tsg {

/// CPU time that the calling thread has used, nanoseconds: what else the machine does is not in it.
[[nodiscard]] std::int64_t thread_cpu_ns();

/// Memory of this process that is in RAM, MiB: now, and the most there ever was.
[[nodiscard]] double resident_mib();
[[nodiscard]] double peak_resident_mib();

}  // namespace tsg
