#include "services/tsgctl/lib/tracking_log.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

TEST(TrackingLog, CountsTrackedLostAndDropped) {
  TrackingLog log;
  log.add({.seq = 0, .tracked = true});
  log.add({.seq = 1, .tracked = false, .frames_dropped = 0});
  log.add({.seq = 4, .tracked = true, .frames_dropped = 2});
  const TrackingTotals totals = log.totals();
  EXPECT_EQ(totals.answered, 3U);
  EXPECT_EQ(totals.tracked, 2U);
  EXPECT_EQ(totals.lost, 1U);
  EXPECT_EQ(totals.dropped, 2U);
}

TEST(TrackingLog, MaskAgeLeavesOutFramesWithoutMask) {
  TrackingLog log;
  log.add({.mask_age_frames = -1});
  log.add({.mask_age_frames = 3});
  log.add({.mask_age_frames = 5});
  const TrackingTotals totals = log.totals();
  EXPECT_EQ(totals.with_mask, 2U);
  EXPECT_DOUBLE_EQ(totals.mask_age_frames.p50, 4.0);
}

TEST(TrackingLog, TimesAreMillisecondsByStage) {
  TrackingLog log;
  for (int i = 1; i <= 3; ++i) {
    const std::int64_t ms = i * 1'000'000;
    log.add({.extract_ns = ms,
             .match_ns = 2 * ms,
             .optimise_ns = 3 * ms,
             .total_ns = 6 * ms,
             .latency_ns = 7 * ms});
  }
  const TrackingTotals totals = log.totals();
  EXPECT_DOUBLE_EQ(totals.extract_ms.p50, 2.0);
  EXPECT_DOUBLE_EQ(totals.match_ms.p50, 4.0);
  EXPECT_DOUBLE_EQ(totals.optimise_ms.p50, 6.0);
  EXPECT_DOUBLE_EQ(totals.total_ms.p50, 12.0);
  EXPECT_DOUBLE_EQ(totals.latency_ms.p50, 14.0);
  EXPECT_GT(totals.latency_ms.p99, 20.0);
}

TEST(TrackingLog, EmptyRunHasZeroes) {
  const TrackingTotals totals = TrackingLog{}.totals();
  EXPECT_EQ(totals.answered, 0U);
  EXPECT_DOUBLE_EQ(totals.total_ms.p99, 0.0);
}

}  // namespace
}  // namespace tsg
