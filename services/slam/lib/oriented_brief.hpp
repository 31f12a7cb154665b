#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "services/slam/lib/descriptor.hpp"

namespace tsg {

/// Pixels around a corner that angle and descriptor read; corners keep this distance to the border.
inline constexpr int kPatchRadius = 15;

/// Direction, in radians (-pi, pi], from the corner to the centroid of the brightness around it.
/// `image` is CV_8UC1; the patch must lie inside.
[[nodiscard]] float intensity_direction(const cv::Mat& image, int x, int y);

/// BRIEF (Calonder et al. 2010) with its test pattern turned by `angle`, as in ORB (Rublee et al.
/// 2011). `blurred` is the image after a slight blur, without which single pixels decide.
[[nodiscard]] Descriptor oriented_brief(const cv::Mat& blurred, int x, int y, float angle);

/// A number that changes with the test pattern: descriptors of different ones do not compare.
[[nodiscard]] std::uint32_t descriptor_pattern_id();

}  // namespace tsg
