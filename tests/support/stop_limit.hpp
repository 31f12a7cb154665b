#pragma once

#include <chrono>

namespace tsg::test {

/// How long a service may take from SIGTERM to its end. Sanitizers search for leaks and races at
/// the end of a process, on machines that are slow already.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::chrono::seconds kStopLimit{20};
#else
inline constexpr std::chrono::seconds kStopLimit{2};
#endif

}  // namespace tsg::test
