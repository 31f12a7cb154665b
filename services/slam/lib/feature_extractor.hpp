#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/rgbd/rgbd_frame.hpp"
#include "services/slam/lib/corner_detector.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/patch_blur.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// What becomes of features on kDynamic pixels.
enum class DynamicPixels { kLeaveOut, kKeep };

/// Finds uniformly spread multi-scale ORB features with their depth.
/// Deterministic. Not thread-safe: buffers are reused from frame to frame.
class FeatureExtractor {
 public:
  FeatureExtractor(const FeatureConfig& config, const CameraModel& camera);

  /// `verdicts` is empty or CV_8UC1 of the frame's size with a FeatureVerdict per pixel. With
  /// kLeaveOut, features on kDynamic pixels are counted and left out, so that the others fill the
  /// budget.
  [[nodiscard]] Features extract(const RgbdFrame& frame,
                                 const cv::Mat& verdicts,
                                 DynamicPixels dynamic_pixels = DynamicPixels::kLeaveOut);

  /// Of the last frame, the pixels (as captured) of features on kDynamic pixels, spread as those
  /// that were kept are.
  [[nodiscard]] const std::vector<cv::Point>& left_out() const { return left_out_; }

 private:
  void build_pyramid(const cv::Mat& colour);
  void extract_level(std::size_t level, const cv::Mat& verdicts, Features& features);
  void undistort(Features& features) const;
  [[nodiscard]] cv::Point raw_pixel(const Eigen::Vector2f& pixel) const;

  FeatureConfig config_;
  CameraModel camera_;
  CornerDetector detector_;
  std::vector<double> scales_;  ///< of each level: pixels of level 0 per pixel
  std::vector<int> budgets_;    ///< features wanted of each level
  std::vector<cv::Mat> pyramid_;
  std::vector<cv::KeyPoint> corners_;
  std::vector<cv::KeyPoint> dynamic_corners_;
  std::vector<cv::Point> left_out_;
  DynamicPixels dynamic_pixels_ = DynamicPixels::kLeaveOut;
  PatchBlur blur_;
  cv::Mat blurred_;
};

}  // namespace tsg
