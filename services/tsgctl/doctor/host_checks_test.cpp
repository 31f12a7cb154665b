#include "services/tsgctl/doctor/host_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t kGigabyte = 1'000'000'000;
constexpr std::uint64_t kDockersDefault = 67'108'864;

TEST(SharedMemoryCheck, DockersDefaultIsTooSmallAndSaysHowToEnlargeIt) {
  const CheckResult result = judge_shared_memory(kDockersDefault, kDockersDefault, false);
  EXPECT_EQ(result.level, CheckLevel::kFail);
  EXPECT_THAT(result.detail, HasSubstr("67.1 MB"));
  EXPECT_THAT(result.fix, HasSubstr("--shm-size"));
}

TEST(SharedMemoryCheck, EnoughRoomIsFine) {
  EXPECT_EQ(judge_shared_memory(kGigabyte, kGigabyte, false).level, CheckLevel::kOk);
}

TEST(SharedMemoryCheck, LargeButFullFailsUnlessRoudiHasItsShare) {
  EXPECT_EQ(judge_shared_memory(kGigabyte, 1000, false).level, CheckLevel::kFail);
  EXPECT_EQ(judge_shared_memory(kGigabyte, 1000, true).level, CheckLevel::kOk);
}

}  // namespace
}  // namespace tsg
