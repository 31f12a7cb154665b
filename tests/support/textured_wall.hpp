#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "common/rgbd/rgbd_frame.hpp"

namespace tsg::test {

/// A wall full of corners, seen by a camera that looks straight at it: frames with exact poses
/// for tests of whole services. The camera may move sideways and down, parallel to the wall.
class TexturedWall {
 public:
  explicit TexturedWall(double distance_m = 2.0, int seed = 1) : distance_m_(distance_m) {
    cv::RNG random(static_cast<std::uint64_t>(seed));
    for (int i = 0; i < kPatches; ++i) {
      const cv::Point corner(random.uniform(0, kTexture.width), random.uniform(0, kTexture.height));
      const cv::Size size(random.uniform(8, 40), random.uniform(8, 40));
      const cv::Scalar colour(random.uniform(0, 255), random.uniform(0, 255),
                              random.uniform(0, 255));
      cv::rectangle(texture_, cv::Rect(corner, size), colour, cv::FILLED);
    }
  }

  [[nodiscard]] static CameraModel camera() {
    return {.width = 640, .height = 480, .fx = 500.0, .fy = 500.0, .cx = 319.5, .cy = 239.5};
  }

  /// The frame from a camera `x_m` to the right of the start and `y_m` below it.
  [[nodiscard]] RgbdFrame frame(std::uint64_t seq, double x_m, double y_m) const {
    const CameraModel model = camera();
    const double left = (kTexture.width - model.width) / 2.0 + x_m * model.fx / distance_m_;
    const double top = (kTexture.height - model.height) / 2.0 + y_m * model.fy / distance_m_;
    const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1.0, 0.0, left, 0.0, 1.0, top);
    RgbdFrame frame;
    frame.seq = seq;
    frame.stamp_ns = kStartNs + static_cast<std::int64_t>(seq) * kPeriodNs;
    frame.camera = model;
    frame.depth_units_per_metre = 5000.0;
    cv::warpAffine(texture_, frame.colour, shift, cv::Size(model.width, model.height),
                   cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    frame.depth = cv::Mat(model.height, model.width, CV_16UC1,
                          cv::Scalar::all(distance_m_ * frame.depth_units_per_metre));
    return frame;
  }

  static constexpr std::int64_t kStartNs = 1'700'000'000'000'000'000;
  static constexpr std::int64_t kPeriodNs = 33'333'333;

 private:
  static constexpr int kPatches = 4000;
  inline static const cv::Size kTexture{1600, 1200};

  double distance_m_;
  cv::Mat texture_{kTexture, CV_8UC3, cv::Scalar::all(128)};
};

}  // namespace tsg::test
