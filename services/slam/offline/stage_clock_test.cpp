#include "services/slam/offline/stage_clock.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

TEST(StageClock, SharesOutAllTimeAmongTheStages) {
  std::int64_t now_ns = 50 * kMillisecond;
  StageClock clock([&] { return now_ns; });
  clock.start_frame();
  now_ns += 3 * kMillisecond;
  clock.start_tracking();
  now_ns += 1 * kMillisecond;
  clock.begin(TrackingStage::kMatch);
  now_ns += 2 * kMillisecond;
  clock.begin(TrackingStage::kOptimise);
  now_ns += 4 * kMillisecond;
  clock.begin(TrackingStage::kMatch);
  now_ns += 2 * kMillisecond;
  clock.begin(TrackingStage::kDecide);
  now_ns += 1 * kMillisecond;
  clock.start_mapping();
  now_ns += 30 * kMillisecond;
  const FrameCost cost = clock.end_frame();
  EXPECT_DOUBLE_EQ(cost.extract_ms, 3.0);
  EXPECT_DOUBLE_EQ(cost.match_ms, 4.0);
  EXPECT_DOUBLE_EQ(cost.optimise_ms, 4.0);
  EXPECT_DOUBLE_EQ(cost.decide_ms, 2.0);
  EXPECT_DOUBLE_EQ(cost.tracking_ms(), 13.0);
  EXPECT_DOUBLE_EQ(cost.mapping_ms, 30.0);
}

TEST(StageClock, ForgetsTheFrameBeforeAndTheTimeBetween) {
  std::int64_t now_ns = 0;
  StageClock clock([&] { return now_ns; });
  clock.start_frame();
  now_ns += 3 * kMillisecond;
  (void)clock.end_frame();
  now_ns += 100 * kMillisecond;  // images are read
  clock.start_frame();
  now_ns += 1 * kMillisecond;
  clock.start_tracking();
  const FrameCost cost = clock.end_frame();
  EXPECT_DOUBLE_EQ(cost.tracking_ms(), 1.0);
  EXPECT_DOUBLE_EQ(cost.mapping_ms, 0.0);
}

TEST(StageClock, MeasuresNothingWithoutAClock) {
  StageClock clock({});
  clock.start_frame();
  clock.begin(TrackingStage::kMatch);
  EXPECT_DOUBLE_EQ(clock.end_frame().tracking_ms(), 0.0);
}

}  // namespace
}  // namespace tsg
