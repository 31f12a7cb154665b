#include "services/segmentation/counters.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace tsg {
namespace {

TEST(RecentValues, ForgetsWhatIsOlderThanAThousandValues) {
  RecentValues values;
  for (int i = 0; i < 1000; ++i) values.add(100.0);
  EXPECT_EQ(values.summary().count, 1000U);
  EXPECT_DOUBLE_EQ(values.summary().median, 100.0);
  for (int i = 0; i < 1000; ++i) values.add(1.0);
  EXPECT_EQ(values.summary().count, 1000U);
  EXPECT_DOUBLE_EQ(values.summary().max, 1.0);
}

TEST(SegmentationCounters, CountAsBacklogWhatWasTakenAndNeitherAnsweredNorGivenUp) {
  SegmentationCounters counters;
  counters.taken = 9;
  counters.failed = 2;
  counters.given_up = 3;
  counters.add({});
  EXPECT_EQ(counters.backlog(), 3U);
  EXPECT_EQ(counters.to_json()["backlog"], 3);
}

TEST(SegmentationCounters, ReportFramesAndMedianTimesOfTheirStages) {
  SegmentationCounters counters;
  for (const std::int64_t ms : {10, 20, 30}) {
    SegmentationResult result;
    result.times.network_ns = ms * 1'000'000;
    result.times.postprocess_ns = 1'000'000;
    result.left_out = 2;
    counters.add(result);
  }
  const nlohmann::json report = counters.to_json();
  EXPECT_EQ(report["frames"], 3);
  EXPECT_EQ(report["left_out"], 6);
  EXPECT_DOUBLE_EQ(report["network_ms"]["p50"], 20.0);
  EXPECT_DOUBLE_EQ(report["inference_ms"]["p50"], 21.0);
  EXPECT_DOUBLE_EQ(report["latency_ms"]["p99"], 0.0);
}

}  // namespace
}  // namespace tsg
