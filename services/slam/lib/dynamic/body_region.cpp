#include "services/slam/lib/dynamic/body_region.hpp"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "services/slam/lib/dynamic/depth_cells.hpp"
#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr double kCutShort = 0.5;   // share of its border that runs across a surface
constexpr double kBodyDepth = 0.4;  // metres that a thing goes on in depth
constexpr int kBodyCells = 12;      // around what was seen to move: the same thing, mostly

/// Whether most of the marked region's border runs across a surface instead of along its edge.
bool is_cut_short(const cv::Mat& depth, const GrowLimits& one_ring, const cv::Mat& marked) {
  cv::Mat beside;
  cv::dilate(marked, beside, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  const int border = cv::countNonZero(beside) - cv::countNonZero(marked);
  cv::Mat grown = marked.clone();
  grow_over_surface(depth, one_ring, grown);
  return cv::countNonZero(grown) - cv::countNonZero(marked) > kCutShort * border;
}

}  // namespace

DepthRange usual_range(std::vector<double>& depths) {
  const auto cut = static_cast<std::ptrdiff_t>(depths.size() / 20);
  const auto low = depths.begin() + cut;
  const auto high = depths.end() - 1 - cut;
  std::ranges::nth_element(depths, low);
  const double nearest = *low;
  std::ranges::nth_element(depths, high);
  return {nearest, *high};
}

void complete_body(const cv::Mat& depth,
                   const DepthRange& range,
                   double tolerance_m,
                   cv::Mat& marked) {
  const GrowLimits one_ring{.nearest = static_cast<float>(range.nearest - tolerance_m),
                            .farthest = static_cast<float>(range.farthest + tolerance_m),
                            .steps = 1};
  for (int ring = 0; ring < kEdgeCells && is_cut_short(depth, one_ring, marked); ++ring) {
    grow_over_surface(depth, one_ring, marked);
  }
}

cv::Mat body_around(const cv::Mat& seeds, const cv::Mat& known, const cv::Mat& depth) {
  std::vector<double> depths;
  for (int y = 0; y < seeds.rows; ++y) {
    for (int x = 0; x < seeds.cols; ++x) {
      const float z = depth.at<float>(y, x);
      if (seeds.at<std::uint8_t>(y, x) != 0 && z >= kMinDepth) depths.push_back(z);
    }
  }
  if (depths.empty()) return cv::Mat::zeros(seeds.size(), CV_8UC1);
  const auto [nearest, farthest] = usual_range(depths);
  const auto from = static_cast<float>(nearest - kBodyDepth);
  const auto to = static_cast<float>(farthest + kBodyDepth);
  const cv::Mat in_range = (depth >= from) & (depth <= to);
  cv::Mat body = seeds & in_range;
  grow_over_surface(depth, {.nearest = from, .farthest = to, .steps = kBodyCells}, body);
  return body | (known & in_range);
}

}  // namespace tsg
