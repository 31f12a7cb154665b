#include "services/tsgctl/lib/bench_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

BenchFrame frame_of(std::uint64_t seq, int lap, double tracking_ms) {
  return {.seq = seq,
          .lap = lap,
          .is_tracked = true,
          .extract_ms = 0.5 * tracking_ms,
          .match_ms = 0.3 * tracking_ms,
          .optimise_ms = 0.15 * tracking_ms,
          .decide_ms = 0.05 * tracking_ms,
          .tracking_ms = tracking_ms,
          .map_keyframes = 7,
          .map_points = 1000,
          .rss_mib = 80.0};
}

/// Two laps of five frames, the second slower by a tenth and one frame of it lost.
BenchReport two_laps() {
  BenchReport report{.sequence = "data/room",
                     .width = 640,
                     .height = 480,
                     .frames = {},
                     .keyframes = 9,
                     .map_keyframes = 7,
                     .map_points = 1100,
                     .loops = 1,
                     .peak_rss_mib = 96.4,
                     .ate_m = std::nullopt};
  for (int i = 0; i < 10; ++i) {
    const int lap = i / 5;
    report.frames.push_back(
        frame_of(static_cast<std::uint64_t>(i), lap, (10.0 + i % 5) * (lap == 0 ? 1.0 : 1.1)));
  }
  report.frames[0].is_keyframe = true;
  report.frames[0].mapping_ms = 40.0;
  report.frames[9].is_tracked = false;
  report.frames[9].rss_mib = 88.0;
  report.frames[9].map_points = 1100;
  return report;
}

TEST(SpreadOf, TellsQuantilesMeanAndCount) {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) values.push_back(i);
  const Spread spread = spread_of(values);
  EXPECT_EQ(spread.count, 101U);
  EXPECT_DOUBLE_EQ(spread.p50, 50.0);
  EXPECT_DOUBLE_EQ(spread.p90, 90.0);
  EXPECT_DOUBLE_EQ(spread.p99, 99.0);
  EXPECT_DOUBLE_EQ(spread.max, 100.0);
  EXPECT_DOUBLE_EQ(spread.mean, 50.0);
}

TEST(SpreadOf, IsZeroOfNothing) {
  EXPECT_EQ(spread_of({}).count, 0U);
  EXPECT_DOUBLE_EQ(spread_of({}).max, 0.0);
}

TEST(FiguresByLap, TakeTimesOverTheLapAndSizesAtItsEnd) {
  const std::vector<LapFigures> laps = figures_by_lap(two_laps().frames);
  ASSERT_EQ(laps.size(), 2U);
  EXPECT_DOUBLE_EQ(laps[0].tracking_p50_ms, 12.0);
  EXPECT_DOUBLE_EQ(laps[1].tracking_p50_ms, 13.2);
  EXPECT_DOUBLE_EQ(laps[0].rss_mib, 80.0);
  EXPECT_DOUBLE_EQ(laps[1].rss_mib, 88.0);
  EXPECT_EQ(laps[1].map_points, 1100U);
}

TEST(BenchReportText, ShowsStagesMapMemoryAndHowLapsChange) {
  const std::string text = to_text(two_laps());
  EXPECT_THAT(text, HasSubstr("data/room, 640x480, without masks\n"));
  EXPECT_THAT(text, HasSubstr("tracking  12.55"));
  EXPECT_THAT(text, HasSubstr("per keyframe, over 1."));
  EXPECT_THAT(text, HasSubstr("frames     10, 1 without a pose\n"));
  EXPECT_THAT(text, HasSubstr("7 keyframes of 9 made, 1100 points, 1 loops closed"));
  EXPECT_THAT(text, HasSubstr("ATE        no ground truth\n"));
  EXPECT_THAT(text, HasSubstr("change     +10.0 %"));
}

TEST(BenchReportText, HasNoTableOfLapsForOne) {
  BenchReport report = two_laps();
  for (BenchFrame& frame : report.frames) frame.lap = 0;
  EXPECT_THAT(to_text(report), Not(HasSubstr("lap")));
}

TEST(BenchReportJson, HoldsWhatTheTextShows) {
  BenchReport report = two_laps();
  report.ate_m = Summary{.count = 9, .rmse = 0.004};
  const nlohmann::json json = to_json(report);
  EXPECT_EQ(json["frames"], 10);
  EXPECT_EQ(json["frames_lost"], 1);
  EXPECT_DOUBLE_EQ(json["cpu_ms"]["mapping_per_keyframe"]["p50"], 40.0);
  EXPECT_DOUBLE_EQ(json["cpu_ms"]["extract"]["max"], 0.5 * 15.4);
  EXPECT_EQ(json["laps"].size(), 2U);
  EXPECT_DOUBLE_EQ(json["ate_m"]["rmse"], 0.004);
  EXPECT_TRUE(to_json(two_laps())["ate_m"].is_null());
}

TEST(BenchSeries, IsALineAFrameBelowTheNames) {
  const std::string csv = to_csv({frame_of(3, 1, 10.0)});
  EXPECT_EQ(csv,
            "seq,lap,tracked,keyframe,extract_ms,match_ms,optimise_ms,decide_ms,tracking_ms,"
            "mapping_ms,map_keyframes,map_points,rss_mib\n"
            "3,1,1,0,5.000,3.000,1.500,0.500,10.000,0.000,7,1000,80.0\n");
}

}  // namespace
}  // namespace tsg
