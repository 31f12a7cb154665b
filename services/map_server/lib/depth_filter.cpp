#include "services/map_server/lib/depth_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tsg {
namespace {

/// 1/z in 1/m; 0 where nothing was measured.
cv::Mat1f invert(const cv::Mat& depth, double depth_units_per_metre) {
  cv::Mat1f inverse(depth.rows, depth.cols);
  const auto units = static_cast<float>(depth_units_per_metre);
  for (int v = 0; v < depth.rows; ++v) {
    const auto* raw = depth.ptr<std::uint16_t>(v);
    float* out = inverse[v];
    for (int u = 0; u < depth.cols; ++u) {
      out[u] = raw[u] == 0 ? 0.0F : units / static_cast<float>(raw[u]);
    }
  }
  return inverse;
}

struct Limits {
  float min_inverse;
  float max_inverse;
  float max_step;
};

/// One row, judged with the rows above and below it (the row itself at the image's rim).
void judge_row(const cv::Mat1f& inverse, int v, const Limits& limits, std::uint8_t* usable) {
  const float* above = inverse[std::max(v - 1, 0)];
  const float* row = inverse[v];
  const float* below = inverse[std::min(v + 1, inverse.rows - 1)];
  const int last = inverse.cols - 1;
  for (int u = 0; u <= last; ++u) {
    const float here = row[u];
    int on_surface = 0;
    bool steps = false;
    for (const float near :
         {row[std::max(u - 1, 0)], row[std::min(u + 1, last)], above[u], below[u]}) {
      const bool is_close = std::abs(near - here) <= limits.max_step;
      on_surface += is_close ? 1 : 0;
      steps |= !is_close && near > 0.0F;
    }
    const bool in_range = here >= limits.min_inverse && here <= limits.max_inverse;
    usable[u] = in_range && !steps && on_surface >= 2 ? 255 : 0;
  }
}

}  // namespace

std::vector<std::string> DepthFilterConfig::problems() const {
  std::vector<std::string> found;
  if (!(min_depth_m > 0.0)) found.emplace_back("min_depth_m must be > 0");
  if (!(max_depth_m > min_depth_m)) found.emplace_back("max_depth_m must be > min_depth_m");
  if (!(max_inverse_depth_step > 0.0)) {
    found.emplace_back("max_inverse_depth_step must be > 0");
  }
  return found;
}

cv::Mat1b usable_depth(const cv::Mat& depth,
                       double depth_units_per_metre,
                       const DepthFilterConfig& config) {
  const cv::Mat1f inverse = invert(depth, depth_units_per_metre);
  const Limits limits{static_cast<float>(1.0 / config.max_depth_m),
                      static_cast<float>(1.0 / config.min_depth_m),
                      static_cast<float>(config.max_inverse_depth_step)};
  cv::Mat1b usable(depth.rows, depth.cols);
  for (int v = 0; v < depth.rows; ++v) judge_row(inverse, v, limits, usable[v]);
  return usable;
}

}  // namespace tsg
