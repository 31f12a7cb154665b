#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "common/geometry/camera_model.hpp"

namespace tsg {

/// One colour image with depth registered to it. A view: the cv::Mats may look into memory that
/// somebody else owns (shared memory, usually), so whoever keeps pixels clones them.
struct RgbdFrame {
  std::uint64_t seq = 0;      ///< per camera; a hole is a dropped frame
  std::int64_t stamp_ns = 0;  ///< capture time, UTC
  CameraModel camera;
  double depth_units_per_metre = 1000.0;  ///< raw depth / this = metres
  cv::Mat colour;  ///< CV_8UC3, BGR, camera.height x camera.width, as captured (not undistorted)
  cv::Mat depth;   ///< CV_16UC1 of the same size; 0 where the sensor saw nothing
};

}  // namespace tsg
