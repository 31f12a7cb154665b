#include "services/map_server/lib/depth_filter.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

namespace tsg {
namespace {

constexpr double kMillimetres = 1000.0;

cv::Mat1w surface_at(int depth_mm) {
  return cv::Mat1w(40, 60, static_cast<std::uint16_t>(depth_mm));
}

TEST(DepthFilter, KeepsEveryPixelOfASurface) {
  EXPECT_EQ(cv::countNonZero(usable_depth(surface_at(2000), kMillimetres, {})), 40 * 60);
}

TEST(DepthFilter, KeepsASlantedFloor) {
  cv::Mat1w depth(240, 60);  // floor 1 m below a level camera of focal length 535 px
  for (int v = 0; v < depth.rows; ++v) {
    depth.row(v).setTo(static_cast<std::uint16_t>(1000.0 * 535.0 / (v + 120)));
  }
  EXPECT_EQ(cv::countNonZero(usable_depth(depth, kMillimetres, {})), depth.rows * depth.cols);
}

TEST(DepthFilter, DropsWhatIsNearerOrFartherThanTheLimits) {
  EXPECT_EQ(cv::countNonZero(usable_depth(surface_at(200), kMillimetres, {})), 0);
  EXPECT_EQ(cv::countNonZero(usable_depth(surface_at(5100), kMillimetres, {})), 0);
}

TEST(DepthFilter, DropsAFlyingPixelMidwayBetweenTwoSurfaces) {
  cv::Mat1w depth = surface_at(1000);
  depth.colRange(31, 60).setTo(3000);
  depth.col(30).setTo(1500);  // half way in 1/z: a filter on curvature would keep it
  const cv::Mat1b usable = usable_depth(depth, kMillimetres, {});
  EXPECT_EQ(cv::countNonZero(usable.col(30)), 0);
  EXPECT_EQ(cv::countNonZero(usable.col(28)), 40);
  EXPECT_EQ(cv::countNonZero(usable.col(33)), 40);
}

TEST(DepthFilter, DropsIsolatedPixelsAndKeepsTheRimOfAHole) {
  cv::Mat1w lone(40, 60, std::uint16_t{0});
  lone(20, 30) = 1000;
  EXPECT_EQ(cv::countNonZero(usable_depth(lone, kMillimetres, {})), 0);
  cv::Mat1w holed = surface_at(1000);
  holed.colRange(20, 30).setTo(0);
  EXPECT_EQ(cv::countNonZero(usable_depth(holed, kMillimetres, {})), 40 * 50);
}

TEST(DepthFilter, NamesEveryUnusableSetting) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ((DepthFilterConfig{0.0, -1.0, nan}.problems().size()), 3U);
  EXPECT_TRUE(DepthFilterConfig{}.problems().empty());
}

}  // namespace
}  // namespace tsg
