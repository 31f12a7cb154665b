#pragma once

#include <opencv2/core/mat.hpp>

#include "common/simulation/people/look.hpp"

namespace tsg::simulation {

/// Lengths of the body that the height of a texture covers.
inline constexpr float kTopTextureM = 0.66F;
inline constexpr float kSleeveTextureM = 0.66F;
inline constexpr float kBottomTextureM = 0.95F;

/// All images: CV_8UC3, BGR, sRGB-coded, 512 pixels or less on a side. u 0.5 is in front.

/// Cloth of the given size, with weave and folds.
[[nodiscard]] cv::Mat paint_cloth(const Cloth& cloth, const cv::Size2d& size_m);
/// A shirt, jumper or jacket around the trunk: cloth with buttons, zip, pocket or print.
[[nodiscard]] cv::Mat paint_top(const Look& look);
[[nodiscard]] cv::Mat paint_bottom(const Look& look);
[[nodiscard]] cv::Mat paint_tights(const Look& look);
[[nodiscard]] cv::Mat paint_shoe(const Look& look);
[[nodiscard]] cv::Mat paint_skin(const Look& look);
[[nodiscard]] cv::Mat paint_face(const Look& look);
[[nodiscard]] cv::Mat paint_hair(const Look& look);

}  // namespace tsg::simulation
