#include "services/tsgctl/bench/scale_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using ::testing::HasSubstr;

BenchReport run_of(std::size_t frames) {
  BenchReport report{.sequence = "it's a room",
                     .width = 640,
                     .height = 480,
                     .frames = std::vector<BenchFrame>(frames),
                     .ate_m = std::nullopt};
  for (std::size_t i = 0; i < frames; ++i) {
    report.frames[i] = {.seq = i,
                        .lap = static_cast<int>(2 * i / frames),
                        .tracking_ms = 10.0 + static_cast<double>(i % 7),
                        .map_keyframes = 20,
                        .map_points = 3000,
                        .rss_mib = 90.0};
  }
  return report;
}

TEST(ScalePlot, DrawsMediansOfStretchesHoweverLongTheRunIs) {
  const std::string script = scale_plot_script(run_of(18'000), "a.png");
  const auto begin = script.begin() + static_cast<std::ptrdiff_t>(script.find("<< EOD\n")) + 7;
  const auto end = script.begin() + static_cast<std::ptrdiff_t>(script.find("\nEOD\n")) + 1;
  EXPECT_EQ(std::count(begin, end, '\n'), 120);
  EXPECT_THAT(script, HasSubstr("\n75 13 16 90 20 3\n"));
  EXPECT_THAT(script, HasSubstr("'it''s a room, 640x480: 18000 frames, 2 times round'"));
}

TEST(ScalePlot, IsAPicture) {
  const test::TempFolder folder;
  const auto drawn = plot_scale(run_of(50), folder / "p.png");
  ASSERT_TRUE(drawn) << drawn.error().message;
  const cv::Mat picture = cv::imread((folder / "p.png").string(), cv::IMREAD_GRAYSCALE);
  ASSERT_EQ(picture.size(), cv::Size(1200, 1100));
  EXPECT_GT(cv::countNonZero(picture < 250), 5000);
}

}  // namespace
}  // namespace tsg
