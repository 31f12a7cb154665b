#pragma once

#include <chrono>
#include <thread>

namespace tsg::test {

/// Whether `condition` becomes true within `timeout`; looks every 5 ms. For what nothing signals,
/// such as another process's state; waits on the bus have deadlines of their own.
template <typename Condition>
[[nodiscard]] bool eventually(std::chrono::milliseconds timeout, Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace tsg::test
