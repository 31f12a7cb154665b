#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "common/rgbd/instances.hpp"
#include "services/slam/lib/dynamic/class_policy.hpp"
#include "services/slam/lib/dynamic/frame_verdicts.hpp"

namespace tsg {

/// What a picture of one frame's verdicts shows. All but `mask` must be there.
struct DebugView {
  std::uint64_t seq = 0;
  bool is_tracked = false;
  cv::Mat colour;                              ///< CV_8UC3
  const InstanceSegmentation* mask = nullptr;  ///< that the verdicts are based on; null: none
  const FrameVerdicts* verdicts = nullptr;
  const DynamicFilterConfig* config = nullptr;
};

/// Features beyond this distance from their epipolar line, pixels, are ringed.
inline constexpr float kEpipolarOutlierPx = 1.0F;

/// The colour image enlarged, with outlines of the mask's instances and boxes of those that are
/// followed, coloured by state, features by verdict, and a legend below. CV_8UC3.
[[nodiscard]] cv::Mat draw_verdicts(const DebugView& view);

}  // namespace tsg
