#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

namespace tsg {

/// Finds FAST corners that are strong where the image allows and spread over all of it.
/// Deterministic. Not thread-safe: buffers are reused from call to call.
class CornerDetector {
 public:
  /// Grey-value thresholds: `threshold` everywhere, `min_threshold` in tiles that it leaves bare.
  CornerDetector(int threshold, int min_threshold)
      : threshold_(threshold), min_threshold_(min_threshold) {}

  /// All corners at least `margin` (>= 3) pixels inside `image` (CV_8UC1), each the best of its 3x3
  /// neighbourhood. Valid until the next call.
  const std::vector<cv::KeyPoint>& detect(const cv::Mat& image, int margin);

 private:
  void search_bare_tiles(const cv::Mat& image, const cv::Rect& inside);

  int threshold_;
  int min_threshold_;
  std::vector<cv::KeyPoint> corners_;
  std::vector<cv::KeyPoint> found_;
  std::vector<int> tile_counts_;
};

/// Keeps at most `wanted` of `corners` in an image of `size`: of each cell of a grid the strongest
/// first, then of each cell the second and so on. Deterministic, whatever their order was.
void keep_spread(std::vector<cv::KeyPoint>& corners, const cv::Size& size, int wanted);

}  // namespace tsg
