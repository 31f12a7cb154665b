#include "services/camera/lib/pacing.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

constexpr std::int64_t kFirst = 1'700'000'000'000'000'000;
constexpr std::int64_t kStart = 5'000'000'000;
constexpr std::int64_t kPeriod = 40'000'000;

TEST(ReplayPacer, FirstFrameIsDueAtTheStartOthersByTheirStamps) {
  const ReplayPacer pacer(kFirst, kStart, 25.0);
  EXPECT_EQ(pacer.due_ns(kFirst), kStart);
  EXPECT_EQ(pacer.due_ns(kFirst + 123'456'789), kStart + 123'456'789);
}

TEST(ReplayPacer, FrameIsEarlyThenDueForAPeriodThenLate) {
  const ReplayPacer pacer(kFirst, kStart, 25.0);
  EXPECT_EQ(pacer.timing(kFirst, kStart - 1), Timing::kEarly);
  EXPECT_EQ(pacer.timing(kFirst, kStart), Timing::kDue);
  EXPECT_EQ(pacer.timing(kFirst, kStart + kPeriod), Timing::kDue);
  EXPECT_EQ(pacer.timing(kFirst, kStart + kPeriod + 1), Timing::kLate);
}

TEST(ReplayPacer, AStallCostsTheFramesOfItsTimeAndNoMore) {
  const ReplayPacer pacer(kFirst, kStart, 25.0);
  const std::int64_t after_stall_ns = kStart + 10 * kPeriod;
  int late = 0;
  for (int frame = 0; frame < 20; ++frame) {
    if (pacer.timing(kFirst + frame * kPeriod, after_stall_ns) == Timing::kLate) ++late;
  }
  EXPECT_EQ(late, 9);  // frames 0 to 8; frame 9 is one period behind, which is still in time
}

}  // namespace
}  // namespace tsg
