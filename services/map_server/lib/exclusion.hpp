#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "services/map_server/lib/keyframe.hpp"

namespace tsg {

/// What does not go into the map, and how much around it.
struct ExclusionConfig {
  /// COCO classes that move by themselves: never mapped, standing still or not.
  std::vector<std::string> dynamic_classes{"person", "bird",     "cat",  "dog",   "horse",  "sheep",
                                           "cow",    "elephant", "bear", "zebra", "giraffe"};
  /// Masks miss up to this much at the rim, and depth does not end where colour does.
  int margin_px = 4;
  /// Beyond the rim, pixels go that are joined to the instance by depth (an arm that the mask
  /// missed), as far as this.
  int growth_px = 15;
  /// Depth of neighbouring pixels of one body differs by no more, relative to the depth.
  double growth_depth_ratio = 0.02;

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// True where the map must not hold the instance: its class is dynamic or it is seen to move.
[[nodiscard]] bool is_excluded(const Instance& instance, const ExclusionConfig& config);

/// 255 where a pixel shows an excluded instance or may do so; 0 elsewhere. All 0 without labels.
[[nodiscard]] cv::Mat1b excluded_pixels(const MapKeyframe& keyframe, const ExclusionConfig& config);

}  // namespace tsg
