#include "common/simulation/sensor/colour_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core/utility.hpp>

#include "common/render/preview.hpp"
#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr std::uint64_t kColourNoise = 16;
// Of full white: 0.0025 in the dark, 0.011 at white, as small sensors have it at 30 Hz indoors.
constexpr float kReadNoise = 0.0025F;
constexpr float kShotNoise = 0.00012F;  // variance per light
constexpr float kCornerLoss = 0.25F;    // of the light in the very corners
constexpr float kThroughHand = 0.006F;  // what a hand before the lens lets through
constexpr int kMaxTaps = 24;

/// Mean along the way that the pixel's surface moves while the shutter is open.
cv::Vec3f blurred(const render::Picture& picture, int y, int x) {
  const auto& motion = picture.motion_px.at<cv::Vec2f>(y, x);
  const float length_px = std::sqrt(motion[0] * motion[0] + motion[1] * motion[1]);
  const int taps = std::min(static_cast<int>(std::ceil(length_px)), kMaxTaps);
  if (taps < 2) return picture.radiance.at<cv::Vec3f>(y, x);
  cv::Vec3f sum(0.0F, 0.0F, 0.0F);
  for (int i = 0; i < taps; ++i) {
    const float along = (static_cast<float>(i) + 0.5F) / static_cast<float>(taps) - 0.5F;
    const int tap_x = std::clamp(cvRound(static_cast<float>(x) + along * motion[0]), 0,
                                 picture.radiance.cols - 1);
    const int tap_y = std::clamp(cvRound(static_cast<float>(y) + along * motion[1]), 0,
                                 picture.radiance.rows - 1);
    sum += picture.radiance.at<cv::Vec3f>(tap_y, tap_x);
  }
  return sum * (1.0F / static_cast<float>(taps));
}

}  // namespace

ColourSensor::ColourSensor(const SensorDescription& sensor,
                           const NoiseTable& noise,
                           double exposure,
                           std::uint64_t seed)
    : sensor_(sensor),
      noise_(noise),
      exposure_(exposure),
      drift_phase_rad_(Random(seed_of(seed, "exposure")).uniform(0.0, kTwoPi)) {}

float ColourSensor::exposure_at(double time_s) const {
  if (!sensor_.exposure_drift) return static_cast<float>(exposure_);
  const double slow = 0.07 * std::sin(kTwoPi * time_s / 7.3 + drift_phase_rad_);
  const double quick = 0.03 * std::sin(kTwoPi * time_s / 2.9 + 2.0 * drift_phase_rad_);
  return static_cast<float>(exposure_ * (1.0 + slow + quick));
}

cv::Mat ColourSensor::expose(const render::Picture& picture,
                             std::uint64_t frame,
                             double time_s,
                             bool covered) const {
  cv::Mat light(picture.radiance.size(), CV_32FC3);
  const float exposure = exposure_at(time_s) * (covered ? kThroughHand : 1.0F);
  cv::parallel_for_(cv::Range(0, light.rows), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      expose_row(picture, frame, y, exposure, light.ptr<cv::Vec3f>(y));
    }
  });
  return render::to_srgb(light);
}

void ColourSensor::expose_row(const render::Picture& picture,
                              std::uint64_t frame,
                              int y,
                              float exposure,
                              cv::Vec3f* light) const {
  const int width = picture.radiance.cols;
  const float half_height = 0.5F * static_cast<float>(picture.radiance.rows);
  const float half_width = 0.5F * static_cast<float>(width);
  const float up = (static_cast<float>(y) - half_height) / half_height;
  const auto noise = noise_.stretch(noise_key(frame, static_cast<std::uint64_t>(y), kColourNoise),
                                    3 * static_cast<std::size_t>(width));
  for (int x = 0; x < width; ++x) {
    cv::Vec3f value =
        sensor_.motion_blur ? blurred(picture, y, x) : picture.radiance.at<cv::Vec3f>(y, x);
    const float right = (static_cast<float>(x) - half_width) / half_width;
    const float corner = 0.5F * (right * right + up * up);
    value *= exposure * (sensor_.vignetting ? 1.0F - kCornerLoss * corner * corner : 1.0F);
    if (sensor_.colour_noise) {
      for (int channel = 0; channel < 3; ++channel) {
        const float deviation =
            std::sqrt(kReadNoise * kReadNoise + kShotNoise * std::max(value[channel], 0.0F));
        value[channel] += deviation * noise[static_cast<std::size_t>(3 * x + channel)];
      }
    }
    light[x] = value;
  }
}

}  // namespace tsg::simulation
