#include "services/slam/lib/depth_sampler.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tsg {
namespace {

constexpr int kRadius = 2;  // 5x5 pixels: registration is off by a pixel or two
constexpr std::size_t kPixels = 25;
constexpr int kMinAgreeing = 5;      // of 25
constexpr double kStepSigmas = 6.0;  // inverse depths further apart lie on two surfaces

}  // namespace

float sample_inverse_depth(const cv::Mat& depth,
                           double units_per_metre,
                           const cv::Point& pixel,
                           const FeatureConfig& config) {
  std::array<std::uint16_t, kPixels> raws{};
  std::size_t count = 0;
  for (int y = std::max(0, pixel.y - kRadius); y <= std::min(depth.rows - 1, pixel.y + kRadius);
       ++y) {
    const auto* row = depth.ptr<std::uint16_t>(y);
    for (int x = std::max(0, pixel.x - kRadius); x <= std::min(depth.cols - 1, pixel.x + kRadius);
         ++x) {
      if (row[x] > 0) raws[count++] = row[x];
    }
  }
  if (count < kMinAgreeing) return 0.0F;
  // A corner at the edge of a thing belongs to the thing: take the nearest surface.
  std::sort(raws.begin(), raws.begin() + static_cast<std::ptrdiff_t>(count));
  std::array<double, kPixels> values{};  // inverse depths, largest first
  for (std::size_t i = 0; i < count; ++i) values[i] = units_per_metre / raws[i];
  const double step = kStepSigmas * config.inverse_depth_sigma;
  std::size_t first = 0;
  std::size_t last = 0;  // of a run of inverse depths without a step
  for (std::size_t i = 1; i <= count; ++i) {
    if (i < count && values[i - 1] - values[i] <= step) {
      last = i;
      continue;
    }
    if (last - first + 1 >= kMinAgreeing) break;
    first = i;
    last = i;
  }
  if (first >= count || last - first + 1 < kMinAgreeing) return 0.0F;
  const double inverse_depth = values[(first + last) / 2];
  const bool believed =
      inverse_depth <= 1.0 / config.min_depth_m && inverse_depth >= 1.0 / config.max_depth_m;
  return believed ? static_cast<float>(inverse_depth) : 0.0F;
}

}  // namespace tsg
