#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace tsg {

/// The slight blur under descriptors: a Gaussian of 2 pixels, as in the ORB paper, over 7x7, in
/// whole numbers. Bit for bit what cv::GaussianBlur does with grey images, which takes as long for
/// 640 pixels a row but three times as long for 179, and most levels of a pyramid are small.
/// Not thread-safe: buffers are reused from call to call.
class PatchBlur {
 public:
  /// `image` is CV_8UC1 and at least 4 pixels a side; mirrored at its borders.
  void blur(const cv::Mat& image, cv::Mat& blurred);

 private:
  static constexpr int kTaps = 7;

  void blur_row(const cv::Mat& image, int row);

  std::vector<std::uint8_t> padded_;  ///< a row of the image with what is beside it
  std::array<std::vector<std::int16_t>, kTaps> rows_;  ///< the last ones, blurred along x
};

}  // namespace tsg
