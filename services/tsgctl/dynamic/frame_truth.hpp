#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/dataset/instance_truth.hpp"
#include "services/slam/lib/dynamic/class_policy.hpp"

namespace tsg {

/// What the truth says of the thing that a pixel shows.
enum class TrueState : std::uint8_t {
  kStill,    ///< background, or an instance that does not move
  kMoving,   ///< an instance that moves, whatever its class
  kResting,  ///< an instance of a dynamic class that does not move for the moment
  kUnknown,  ///< an instance whose motion the sequence does not tell
};

/// One instance in view, by the truth.
struct TrueInstance {
  int id = 0;  ///< in instances.json
  std::string class_name;
  std::string name;
  FeatureVerdict prior = FeatureVerdict::kStatic;  ///< by its class
  TrueState state = TrueState::kStill;
};

/// What is true of each pixel of a frame.
struct FrameTruth {
  cv::Mat labels;   ///< CV_8UC1: 0 = background, i + 1 = instances[i]
  cv::Mat at_edge;  ///< CV_8UC1: not 0 where things of another state are near
  std::vector<TrueInstance> instances;
};

/// `margin_px`: pixels count as at an edge where the state changes within so many rows and columns.
[[nodiscard]] FrameTruth make_frame_truth(const TrueMask& mask,
                                          const std::map<int, KnownInstance>& known,
                                          const DynamicFilterConfig& config,
                                          int margin_px);

}  // namespace tsg
