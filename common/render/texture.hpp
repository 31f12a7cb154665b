#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace tsg::render {

/// An image wrapped round a surface, repeating in u and v, with ever smaller copies of itself so
/// that distant surfaces do not shimmer. Immutable.
class Texture {
 public:
  /// `image` CV_8UC3, BGR, sRGB-coded; both sides powers of two, 1..4096.
  explicit Texture(const cv::Mat& image);

  /// Linear-light BGR (0..1) around `uv` (1 = the whole texture; v down), averaged over a square
  /// whose side is `footprint` of the texture's height.
  [[nodiscard]] Eigen::Vector3f sample(const Eigen::Vector2f& uv, float footprint) const;

 private:
  [[nodiscard]] Eigen::Vector3f sample_level(int level, const Eigen::Vector2f& uv) const;

  std::vector<cv::Mat> levels_;  ///< CV_8UC3, each half the size of the one before
};

}  // namespace tsg::render
