#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace tsg {

/// Which depth measurements are good enough for a map.
struct DepthFilterConfig {
  double min_depth_m = 0.3;  ///< structured-light and stereo cameras see nothing true below this
  double max_depth_m = 5.0;  ///< the error grows with z^2: about one leaf (5 cm) here
  /// Largest change of 1/z between neighbouring pixels of one surface, in 1/m. On a plane 1/z is
  /// linear in the image, with slope 1 / (focal length * distance of the plane): 0.002 for a floor
  /// 1 m below. 0.02 is 2 cm at 1 m and 32 cm at 4 m: five times the noise of a Kinect.
  double max_inverse_depth_step = 0.02;

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// 255 where a pixel's depth is in range and lies on a surface: flying pixels at depth
/// discontinuities and isolated ones are 0. `depth` is CV_16UC1; 0 = nothing measured.
[[nodiscard]] cv::Mat1b usable_depth(const cv::Mat& depth,
                                     double depth_units_per_metre,
                                     const DepthFilterConfig& config);

}  // namespace tsg
