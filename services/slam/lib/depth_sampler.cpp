#include "services/slam/lib/depth_sampler.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tsg {
namespace {

constexpr int kRadius = 2;  // 5x5 pixels: registration is off by a pixel or two
constexpr std::size_t kPixels = 25;
constexpr std::size_t kMinAgreeing = 5;  // of 25
constexpr double kStepSigmas = 6.0;      // inverse depths further apart lie on two surfaces

/// A run of depths without a step, by index; `last` is one of it.
struct Run {
  std::size_t first = 0;
  std::size_t last = 0;

  [[nodiscard]] bool is_believed() const { return last - first + 1 >= kMinAgreeing; }
};

/// The nearest surface among inverse depths, given by index from the nearest on: the first run that
/// is long enough, else the last one.
template <typename InverseDepth>
Run nearest_surface(const InverseDepth& inverse_depth, std::size_t count, double step) {
  // Mostly there is one surface, and the ends of the list tell.
  if (inverse_depth(0) - inverse_depth(count - 1) <= step) return {0, count - 1};
  Run run;
  for (std::size_t i = 1; i < count; ++i) {
    if (inverse_depth(i - 1) - inverse_depth(i) <= step) {
      run.last = i;
      continue;
    }
    if (run.is_believed()) break;
    run = {i, i};
  }
  return run;
}

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
  const auto inverse_depth_at = [&](std::size_t i) { return units_per_metre / raws[i]; };
  const Run run =
      nearest_surface(inverse_depth_at, count, kStepSigmas * config.inverse_depth_sigma);
  if (!run.is_believed()) return 0.0F;
  const double inverse_depth = inverse_depth_at((run.first + run.last) / 2);
  const bool believed =
      inverse_depth <= 1.0 / config.min_depth_m && inverse_depth >= 1.0 / config.max_depth_m;
  return believed ? static_cast<float>(inverse_depth) : 0.0F;
}

}  // namespace tsg
