#include "common/simulation/sensor/depth_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "common/simulation/random.hpp"
#include "common/simulation/simulator.hpp"

namespace tsg::simulation {
namespace {

constexpr double kBaselineM = 0.075;
// Disparity is measured by an infrared camera of its own, whatever the size of the colour image.
constexpr float kInfraredFocalPx = 580.0F;
constexpr float kDisparityTimesDepth = kInfraredFocalPx * 0.075F;  // pixel metres
constexpr float kDisparityStep = 0.125F;                           // pixels
constexpr float kDisparityNoise = 0.062F;                          // pixels, standard deviation
constexpr int kPatchPx = 8;  // disparities are found by patches: their errors go together
constexpr float kSilhouetteStep = 0.03F;  // of the depth
constexpr float kHiddenPx = 0.75F;        // of the projector's image: overlaps below are rounding
// Echoes fail at random between these cosines, always below.
constexpr float kNoEchoFacing = 0.10F;
constexpr float kSureEchoFacing = 0.22F;
constexpr float kSpeckle = 3.1F;  // standard deviations: 0.1 % of all pixels fail for no reason

enum Purpose : std::uint64_t { kPixelNoise = 1, kPatchNoise = 2, kEcho = 3 };

std::uint16_t to_raw(float depth_m) {
  const float raw = std::round(depth_m * static_cast<float>(kDepthUnitsPerMetre));
  return raw >= 1.0F && raw <= 65535.0F ? static_cast<std::uint16_t>(raw) : std::uint16_t{0};
}

}  // namespace

DepthSensor::DepthSensor(const SensorDescription& sensor, const NoiseTable& noise)
    : sensor_(sensor),
      noise_(noise),
      colour_disparity_(static_cast<float>(sensor.camera.fx * kBaselineM)) {}

cv::Mat DepthSensor::measure(const render::Picture& picture, std::uint64_t frame) const {
  cv::Mat raw(picture.depth_m.size(), CV_16UC1, cv::Scalar(0));
  cv::parallel_for_(cv::Range(0, raw.rows), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      measure_row(picture, frame, y, raw);
      if (!sensor_.depth_holes) continue;
      drop_shadowed(picture.depth_m.ptr<float>(y), raw.ptr<std::uint16_t>(y));
      drop_weak_echoes(picture, frame, y, raw.ptr<std::uint16_t>(y));
    }
  });
  return raw;
}

void DepthSensor::measure_row(const render::Picture& picture,
                              std::uint64_t frame,
                              int y,
                              cv::Mat& raw) const {
  const auto* const depth_m = picture.depth_m.ptr<float>(y);
  auto* const raw_row = raw.ptr<std::uint16_t>(y);
  const auto width = static_cast<std::size_t>(raw.cols);
  const auto row = static_cast<std::uint64_t>(y);
  const auto pixel_noise = noise_.stretch(noise_key(frame, row, kPixelNoise), width);
  const auto patch_noise =
      noise_.stretch(noise_key(frame, row / kPatchPx, kPatchNoise), width / kPatchPx + 2);
  for (std::size_t x = 0; x < width; ++x) {
    if (depth_m[x] <= 0.0F) continue;
    float disparity = kDisparityTimesDepth / depth_m[x];
    if (sensor_.depth_noise) {
      const float share = static_cast<float>(x % kPatchPx) / kPatchPx;
      const float patch =
          (1.0F - share) * patch_noise[x / kPatchPx] + share * patch_noise[x / kPatchPx + 1];
      // Half of the variance is the patch's, half the pixel's own.
      disparity += kDisparityNoise * 0.7071F * (patch + pixel_noise[x]);
    }
    if (sensor_.depth_quantisation) {
      disparity = kDisparityStep * std::round(disparity / kDisparityStep);
    }
    if (disparity <= 0.0F) continue;
    const float measured_m = kDisparityTimesDepth / disparity;
    const bool in_range = measured_m >= static_cast<float>(sensor_.min_depth_m) &&
                          measured_m <= static_cast<float>(sensor_.max_depth_m);
    if (in_range || !sensor_.depth_range) raw_row[x] = to_raw(measured_m);
  }
}

void DepthSensor::drop_shadowed(const float* depth_m, std::uint16_t* raw) const {
  // The projector stands to the right of the camera. From its place, what is seen farther right
  // must lie farther right; where the order is reversed, the farther surface gets no light.
  float leftmost = std::numeric_limits<float>::infinity();
  for (int x = sensor_.camera.width - 1; x >= 0; --x) {
    if (depth_m[x] <= 0.0F) continue;
    const float in_projector = static_cast<float>(x) - colour_disparity_ / depth_m[x];
    if (in_projector > leftmost + kHiddenPx) raw[x] = 0;
    leftmost = std::min(leftmost, in_projector);
  }
}

void DepthSensor::drop_weak_echoes(const render::Picture& picture,
                                   std::uint64_t frame,
                                   int y,
                                   std::uint16_t* raw) const {
  const auto* const facing = picture.facing.ptr<float>(y);
  const auto* const returns = picture.returns_depth.ptr<std::uint8_t>(y);
  const auto chance = noise_.stretch(noise_key(frame, static_cast<std::uint64_t>(y), kEcho),
                                     static_cast<std::size_t>(picture.depth_m.cols));
  for (int x = 0; x < picture.depth_m.cols; ++x) {
    if (raw[x] == 0) continue;
    const float luck = chance[static_cast<std::size_t>(x)];
    const float echo = (facing[x] - kNoEchoFacing) / (kSureEchoFacing - kNoEchoFacing);
    // 1.5 standard deviations to either side: 93 % of what chance gives.
    const bool is_too_flat = echo <= 0.0F || (echo < 0.5F + luck / 3.0F && echo < 1.0F);
    if (returns[x] == 0 || is_too_flat || luck > kSpeckle ||
        (luck > -0.5F && is_silhouette(picture.depth_m, y, x))) {
      raw[x] = 0;
    }
  }
}

bool DepthSensor::is_silhouette(const cv::Mat& depth_m, int y, int x) const {
  const auto here = depth_m.at<float>(y, x);
  const auto jumps = [&](int other_y, int other_x) {
    if (other_x < 0 || other_y < 0 || other_x >= depth_m.cols || other_y >= depth_m.rows) {
      return false;
    }
    return std::abs(depth_m.at<float>(other_y, other_x) - here) > kSilhouetteStep * here;
  };
  return jumps(y, x - 1) || jumps(y, x + 1) || jumps(y - 1, x) || jumps(y + 1, x) ||
         jumps(y, x - 2) || jumps(y, x + 2);
}

}  // namespace tsg::simulation
