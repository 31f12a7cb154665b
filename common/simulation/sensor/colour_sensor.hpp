#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "common/render/renderer.hpp"
#include "common/simulation/scene.hpp"
#include "common/simulation/sensor/noise_table.hpp"

namespace tsg::simulation {

/// A cheap colour camera: blur of what moves, darker corners, an exposure that wanders, noise of
/// photons and of electronics.
class ColourSensor {
 public:
  /// `exposure` makes of radiance 1 the light that the sensor calls white.
  ColourSensor(const SensorDescription& sensor,
               const NoiseTable& noise,
               double exposure,
               std::uint64_t seed);

  /// CV_8UC3 of an ideal picture at `time_s`; `covered`: a hand before the lens.
  [[nodiscard]] cv::Mat expose(const render::Picture& picture,
                               std::uint64_t frame,
                               double time_s,
                               bool covered) const;

 private:
  [[nodiscard]] float exposure_at(double time_s) const;
  void expose_row(const render::Picture& picture,
                  std::uint64_t frame,
                  int y,
                  float exposure,
                  cv::Vec3f* light) const;

  SensorDescription sensor_;
  const NoiseTable& noise_;
  double exposure_;
  double drift_phase_rad_;
};

}  // namespace tsg::simulation
