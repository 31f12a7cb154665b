#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

namespace tsg {

/// Most instances that one frame can carry: labels are 8 bits and the wire type is fixed-size.
inline constexpr int kMaxInstances = 64;

enum class MotionVerdict { kUnknown, kStatic, kMoving };

/// One segmented object of a frame.
struct Instance {
  std::string class_name;  ///< COCO class, e.g. "person"
  float score = 0.0F;      ///< 0..1
  cv::Rect2f box;          ///< pixels
  MotionVerdict motion = MotionVerdict::kUnknown;
  /// The same in all masks that show this thing; 0 where nobody follows it from mask to mask.
  std::uint32_t track_id = 0;
};

/// The instances of one frame. `labels` is a view like RgbdFrame's images.
struct InstanceSegmentation {
  std::uint64_t frame_seq = 0;
  std::int64_t stamp_ns = 0;
  cv::Mat labels;  ///< CV_8UC1, the frame's size: 0 = none, i + 1 = instances[i]
  std::vector<Instance> instances;
};

}  // namespace tsg
