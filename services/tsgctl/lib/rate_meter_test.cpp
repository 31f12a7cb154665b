#include "services/tsgctl/lib/rate_meter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kMillisecond = 1'000'000;

TEST(RateMeter, TellsRateAndItsBounds) {
  RateMeter meter(10);
  for (const std::int64_t at_ms : {0, 20, 60}) meter.add({.received_ns = at_ms * kMillisecond});
  const RateSummary summary = meter.summary();
  EXPECT_DOUBLE_EQ(summary.rate_hz, 1000.0 / 30.0);
  EXPECT_DOUBLE_EQ(summary.slowest_hz, 25.0);
  EXPECT_DOUBLE_EQ(summary.fastest_hz, 50.0);
  EXPECT_DOUBLE_EQ(summary.jitter_ms, 10.0);
  EXPECT_FALSE(summary.latency_ms.has_value());
}

TEST(RateMeter, ForgetsWhatLeftTheWindow) {
  RateMeter meter(2);
  for (const std::int64_t at_ms : {0, 900, 1000}) meter.add({.received_ns = at_ms * kMillisecond});
  EXPECT_DOUBLE_EQ(meter.summary().rate_hz, 10.0);
  EXPECT_EQ(meter.summary().samples, 2U);
}

TEST(RateMeter, MeasuresLatencyAndHoles) {
  RateMeter meter(10);
  meter.add({.received_ns = 5 * kMillisecond, .published_ns = 3 * kMillisecond, .seq = 7});
  meter.add({.received_ns = 9 * kMillisecond, .published_ns = 7 * kMillisecond, .seq = 10});
  const RateSummary summary = meter.summary();
  ASSERT_TRUE(summary.latency_ms.has_value());
  EXPECT_DOUBLE_EQ(summary.latency_ms->p50, 2.0);
  EXPECT_EQ(summary.missed, 2U);
}

TEST(RateMeter, RestartedPublisherIsNoHole) {
  RateMeter meter(10);
  for (const std::uint64_t seq : {100ULL, 0ULL, 1ULL}) meter.add({.seq = seq});
  EXPECT_EQ(meter.summary().missed, 0U);
}

TEST(RateMeter, OneSampleHasNoRate) {
  RateMeter meter(10);
  meter.add({.received_ns = 1});
  EXPECT_DOUBLE_EQ(meter.summary().rate_hz, 0.0);
}

TEST(RateMeter, TextLeavesOutLatencyWhereMessagesCarryNoTime) {
  EXPECT_THAT(rate_text({.samples = 2, .rate_hz = 30.0}), Not(HasSubstr("latency")));
  EXPECT_THAT(rate_text({.samples = 2, .rate_hz = 30.0, .latency_ms = Percentiles{0.11, 0.2}}),
              HasSubstr("30.00 Hz"));
}

}  // namespace
}  // namespace tsg
