#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/render/stage.hpp"

namespace tsg::render {

/// Radiance (CV_32FC3) as an 8-bit sRGB image: `exposure` times the light, bright parts compressed.
[[nodiscard]] cv::Mat to_srgb(const cv::Mat& radiance, float exposure = 1.0F);

/// Where a picture is taken from.
struct Viewpoint {
  Eigen::Vector3d eye_m;
  Eigen::Vector3d target_m;
  double field_of_view_deg = 50.0;  ///< across the width
  cv::Size size{960, 720};
};

/// A camera pose that looks from a place to another, upright.
[[nodiscard]] SE3 look_at(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m);

/// An image (CV_8UC3) of a stage.
[[nodiscard]] cv::Mat render_view(Stage& stage, const Viewpoint& viewpoint);

/// An image of a mesh alone, in soft light from above: for looking at a model or a map.
[[nodiscard]] cv::Mat render_preview(const Mesh& mesh, const Viewpoint& viewpoint);

}  // namespace tsg::render
