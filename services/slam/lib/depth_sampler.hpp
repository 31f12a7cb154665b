#pragma once

#include <opencv2/core/mat.hpp>

#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Inverse depth (1/m) of a registered depth image (CV_16UC1) at a pixel, from its neighbourhood;
/// 0 where too few pixels agree on one or it lies outside the range that the config believes.
[[nodiscard]] float sample_inverse_depth(const cv::Mat& depth,
                                         double units_per_metre,
                                         const cv::Point& pixel,
                                         const FeatureConfig& config);

}  // namespace tsg
