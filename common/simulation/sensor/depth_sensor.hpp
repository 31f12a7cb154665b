#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "common/render/renderer.hpp"
#include "common/simulation/scene.hpp"
#include "common/simulation/sensor/noise_table.hpp"

namespace tsg::simulation {

/// A structured-light depth camera of the Kinect's class: it measures disparities between a
/// projector and a camera 7.5 cm apart. Noise and quantisation are those of Khoshelham and Elberink
/// (Sensors 2012, 12, 1437-1454): half a step of 1/8 pixel of disparity, so that the error of a
/// depth z grows with z^2 (1.4 mm at 1 m, 35 mm at 5 m).
class DepthSensor {
 public:
  DepthSensor(const SensorDescription& sensor, const NoiseTable& noise);

  /// What it measures of an ideal picture: CV_16UC1, kDepthUnitsPerMetre, 0 = nothing.
  [[nodiscard]] cv::Mat measure(const render::Picture& picture, std::uint64_t frame) const;

 private:
  void measure_row(const render::Picture& picture, std::uint64_t frame, int y, cv::Mat& raw) const;
  void drop_shadowed(const float* depth_m, std::uint16_t* raw) const;
  void drop_weak_echoes(const render::Picture& picture,
                        std::uint64_t frame,
                        int y,
                        std::uint16_t* raw) const;
  [[nodiscard]] bool is_silhouette(const cv::Mat& depth_m, int y, int x) const;

  SensorDescription sensor_;
  const NoiseTable& noise_;
  float colour_disparity_;  ///< pixel metres: shift of the projector's view in the image * depth
};

}  // namespace tsg::simulation
