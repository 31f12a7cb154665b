#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "services/slam/lib/features.hpp"

namespace tsg {

/// What became of a feature that was detected.
struct JudgedFeature {
  std::int16_t raw_x = 0;  ///< pixel as captured
  std::int16_t raw_y = 0;
  FeatureVerdict prior = FeatureVerdict::kStatic;  ///< by the class of its instance alone
  bool is_dynamic = false;                         ///< found to move: not used any further
  float epipolar_px = -1.0F;  ///< distance from its epipolar line; negative: not tested
};

/// What is believed of an instance at the time of a frame.
struct InstanceState {
  int id = 0;  ///< stays the same from frame to frame
  std::string class_name;
  FeatureVerdict prior = FeatureVerdict::kStatic;
  double p_moving = 0.0;
  bool is_moving = false;  ///< its features are dropped
  cv::Rect box;            ///< pixels, where it is by now
};

/// All that was judged in one frame: for evaluation and pictures, not for tracking.
struct FrameVerdicts {
  std::vector<JudgedFeature> features;
  std::vector<InstanceState> instances;
};

}  // namespace tsg
