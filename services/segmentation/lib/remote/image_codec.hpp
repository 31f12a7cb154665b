#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "common/core/error.hpp"

namespace tsg {

/// Images as they go over the network: colour as JPEG, label images as PNG (lossless).
using ImageBytes = std::vector<std::uint8_t>;

/// `bgr` (CV_8UC3) as a JPEG file of `quality` 1 to 100.
[[nodiscard]] Expected<ImageBytes> encode_colour(const cv::Mat& bgr, int quality);

/// kBadData where `jpeg` is damaged or shows an image of another size than `size`.
[[nodiscard]] Expected<cv::Mat> decode_colour(std::span<const std::uint8_t> jpeg, cv::Size size);

/// `labels` (CV_8UC1) as a PNG file.
[[nodiscard]] Expected<ImageBytes> encode_labels(const cv::Mat& labels);

/// Decodes into the memory of `labels`, which has a size and is CV_8UC1. kBadData where `png` is
/// damaged, of another size, or has a label above `most`.
[[nodiscard]] Expected<void> decode_labels(std::span<const std::uint8_t> png,
                                           std::size_t most,
                                           cv::Mat& labels);

}  // namespace tsg
