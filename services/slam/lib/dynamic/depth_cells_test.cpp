#include "services/slam/lib/dynamic/depth_cells.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace tsg {
namespace {

constexpr int kEverywhere = 100;  // steps

/// A surface at 2 m with a column of cells `x` at another depth.
cv::Mat surface_with_column(int x, float depth_m) {
  cv::Mat depth(6, 12, CV_32FC1, 2.0F);
  depth.col(x).setTo(depth_m);
  return depth;
}

/// What the cell at the left end is connected to.
cv::Mat grown(const cv::Mat& depth, const GrowLimits& limits) {
  cv::Mat marked = cv::Mat::zeros(depth.size(), CV_8UC1);
  marked.at<std::uint8_t>(3, 0) = 255;
  grow_over_surface(depth, limits, marked);
  return marked;
}

TEST(GrowOverSurface, ReachesAllThatIsConnected) {
  const cv::Mat marked = grown(surface_with_column(5, 2.05F), {1.0F, 3.0F, kEverywhere});
  EXPECT_EQ(cv::countNonZero(marked), 6 * 12);
}

TEST(GrowOverSurface, TakesOneCellAStep) {
  const cv::Mat marked = grown(surface_with_column(5, 2.0F), {1.0F, 3.0F, 2});
  EXPECT_EQ(cv::countNonZero(marked.row(3)), 3);
}

TEST(GrowOverSurface, StopsAtAnEdge) {
  const cv::Mat marked = grown(surface_with_column(5, 2.4F), {1.0F, 3.0F, kEverywhere});
  EXPECT_EQ(cv::countNonZero(marked), 6 * 5);
}

TEST(GrowOverSurface, StopsBeyondTheLimits) {
  const cv::Mat marked = grown(surface_with_column(5, 2.05F), {1.0F, 2.02F, kEverywhere});
  EXPECT_EQ(cv::countNonZero(marked), 6 * 5);
}

TEST(GrowOverSurface, StopsWhereNothingWasMeasuredHoweverNearTheNearestMayBe) {
  const cv::Mat marked = grown(surface_with_column(1, 0.0F), {-0.3F, 3.0F, kEverywhere});
  EXPECT_EQ(cv::countNonZero(marked), 6);
  cv::Mat from_unmeasured = surface_with_column(0, 0.0F);
  from_unmeasured.col(1).setTo(0.0F);
  EXPECT_EQ(cv::countNonZero(grown(from_unmeasured, {-0.3F, 3.0F, kEverywhere})), 1);
}

TEST(PixelsOfCells, HaveTheValueOfTheirCellAndBesideThoseOfTheNearest) {
  cv::Mat cells(2, 2, CV_8UC1);
  cells.at<std::uint8_t>(0, 0) = 1;
  cells.at<std::uint8_t>(0, 1) = 2;
  cells.at<std::uint8_t>(1, 0) = 3;
  cells.at<std::uint8_t>(1, 1) = 4;
  const cv::Mat pixels = pixels_of_cells(cells, {2 * kCellSide + 1, 2 * kCellSide + 3});
  EXPECT_EQ(pixels.at<std::uint8_t>(kCellSide - 1, kCellSide - 1), 1);
  EXPECT_EQ(pixels.at<std::uint8_t>(kCellSide - 1, kCellSide), 2);
  EXPECT_EQ(pixels.at<std::uint8_t>(kCellSide, kCellSide - 1), 3);
  EXPECT_EQ(pixels.at<std::uint8_t>(2 * kCellSide + 2, 2 * kCellSide), 4) << "beyond the last";
}

}  // namespace
}  // namespace tsg
