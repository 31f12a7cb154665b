#include "services/map_server/lib/exclusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace tsg {
namespace {

cv::Mat square(int radius) {
  return cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1});
}

cv::Mat1b pixels_of_excluded(const MapKeyframe& keyframe, const ExclusionConfig& config) {
  cv::Mat1b table(1, 256, std::uint8_t{0});
  const auto& instances = keyframe.instances.instances;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (is_excluded(instances[i], config)) table(0, static_cast<int>(i + 1)) = 255;
  }
  cv::Mat1b mask;
  cv::LUT(keyframe.instances.labels, table, mask);
  return mask;
}

/// Follows the depth outwards from inside the mask, a pixel a step. Starts `margin_px` inside, as
/// a mask's own rim may show the background already.
class Growth {
 public:
  Growth(const cv::Mat& depth, double depth_ratio, cv::Mat1b& mask)
      : depth_(depth), depth_ratio_(depth_ratio), mask_(mask), seen_(mask.size(), 0) {}

  void run(const cv::Mat1b& core, int steps) {
    start_at_rim_of(core);
    for (int step = 0; step < steps && !front_.empty(); ++step) {
      std::vector<Pixel> next;
      for (const Pixel& pixel : front_) spread(pixel, next);
      front_ = std::move(next);
    }
  }

 private:
  struct Pixel {
    int u;
    int v;
    std::uint16_t
        depth;  ///< raw, not 0: the last one measured on the way here, as holes are crossed
  };

  void start_at_rim_of(const cv::Mat1b& core) {
    cv::Mat1b inner;
    cv::erode(core, inner, square(1));
    core.copyTo(seen_);
    for (int v = 0; v < core.rows; ++v) {
      for (int u = 0; u < core.cols; ++u) {
        const bool at_rim = core(v, u) != 0 && inner(v, u) == 0;
        if (at_rim && depth_at(u, v) != 0) front_.push_back({u, v, depth_at(u, v)});
      }
    }
  }

  void spread(const Pixel& from, std::vector<Pixel>& next) {
    constexpr std::array<std::array<int, 2>, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& [du, dv] : kSteps) {
      const int u = from.u + du;
      const int v = from.v + dv;
      if (u < 0 || v < 0 || u >= mask_.cols || v >= mask_.rows || seen_(v, u) != 0) continue;
      const std::uint16_t depth = depth_at(u, v);
      if (!is_joined(from.depth, depth)) continue;
      seen_(v, u) = 255;
      mask_(v, u) = 255;
      next.push_back({u, v, depth == 0 ? from.depth : depth});
    }
  }

  [[nodiscard]] bool is_joined(std::uint16_t from, std::uint16_t to) const {
    return to == 0 || std::abs(from - to) <= depth_ratio_ * from;
  }
  [[nodiscard]] std::uint16_t depth_at(int u, int v) const {
    return depth_.at<std::uint16_t>(v, u);
  }

  const cv::Mat& depth_;
  const double depth_ratio_;
  cv::Mat1b& mask_;
  cv::Mat1b seen_;
  std::vector<Pixel> front_;
};

}  // namespace

std::vector<std::string> ExclusionConfig::problems() const {
  std::vector<std::string> found;
  if (margin_px < 0 || margin_px > 100) found.emplace_back("mask_margin_px must be 0..100");
  if (growth_px < 0 || growth_px > 200) found.emplace_back("mask_growth_px must be 0..200");
  if (!(growth_depth_ratio >= 0.0 && growth_depth_ratio <= 0.5)) {
    found.emplace_back("mask_growth_depth_ratio must be 0..0.5");
  }
  return found;
}

bool is_excluded(const Instance& instance, const ExclusionConfig& config) {
  if (instance.motion == MotionVerdict::kMoving) return true;
  const auto& classes = config.dynamic_classes;
  return std::find(classes.begin(), classes.end(), instance.class_name) != classes.end();
}

cv::Mat1b excluded_pixels(const MapKeyframe& keyframe, const ExclusionConfig& config) {
  if (!keyframe.has_labels) return {keyframe.frame.depth.size(), std::uint8_t{0}};
  cv::Mat1b mask = pixels_of_excluded(keyframe, config);
  if (cv::countNonZero(mask) == 0) return mask;

  cv::Mat1b core;
  cv::Mat1b grown;
  cv::erode(mask, core, square(config.margin_px));
  cv::dilate(mask, grown, square(config.margin_px));
  Growth(keyframe.frame.depth, config.growth_depth_ratio, grown)
      .run(core, config.margin_px + config.growth_px);
  return grown;
}

}  // namespace tsg
