#include "services/tsgctl/bench/process_use.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace tsg {
namespace {

TEST(ThreadCpuTime, CountsWorkOfThisThreadAndNoOther) {
  const std::int64_t before_ns = thread_cpu_ns();
  std::jthread([] {
    const std::int64_t start_ns = thread_cpu_ns();
    while (thread_cpu_ns() - start_ns < 5'000'000) {
    }
  }).join();
  const std::int64_t waited_ns = thread_cpu_ns() - before_ns;
  EXPECT_LT(waited_ns, 5'000'000) << "the other thread's work is in it";
  while (thread_cpu_ns() - before_ns < waited_ns + 1'000'000) {
  }
  EXPECT_GE(thread_cpu_ns() - before_ns, 1'000'000);
}

TEST(ResidentMemory, GrowsWithWhatIsTouchedAndThePeakRemembersIt) {
  constexpr std::size_t kMib = 1024UL * 1024UL;
  const double before_mib = resident_mib();
  double held_mib = 0.0;
  {
    const std::vector<char> block(64 * kMib, 'x');
    held_mib = resident_mib();
    EXPECT_EQ(block.back(), 'x');
  }
  EXPECT_GT(before_mib, 1.0);
  EXPECT_GE(held_mib, before_mib + 60.0);
  EXPECT_GE(peak_resident_mib(), before_mib + 60.0);
}

}  // namespace
}  // namespace tsg
