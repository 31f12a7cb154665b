#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "common/rgbd/instances.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// A FeatureVerdict for every value of a label image.
using VerdictOfLabel = std::array<FeatureVerdict, 256>;

/// The verdict for each label by the class and score of its instance; labels without one are
/// static, as is the background.
[[nodiscard]] VerdictOfLabel verdict_of_labels(const InstanceSegmentation& mask,
                                               const DynamicFilterConfig& config);

/// A FeatureVerdict for each pixel of the frame that `mask` belongs to (CV_8UC1, its size).
[[nodiscard]] cv::Mat verdicts_of_pixels(const InstanceSegmentation& mask,
                                         const DynamicFilterConfig& config);

/// Raises `verdicts` (CV_8UC1, the mask's size) to those where they are lower.
void raise_verdicts(const InstanceSegmentation& mask,
                    const DynamicFilterConfig& config,
                    cv::Mat& verdicts);

/// What verdicts_of_pixels() says, with dynamic instances dilated by config.dilation_px: without
/// depth their edges are not known better.
[[nodiscard]] cv::Mat exact_verdicts(const InstanceSegmentation& mask,
                                     const DynamicFilterConfig& config);

/// Grows the kDynamic pixels of `verdicts` by `radius_px` in each direction.
void dilate_dynamic(cv::Mat& verdicts, int radius_px);

}  // namespace tsg
