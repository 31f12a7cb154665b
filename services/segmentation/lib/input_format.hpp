#pragma once

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

namespace tsg {

enum class ChannelOrder { kRgb, kBgr };

/// Where a frame lies in an input of another aspect ratio.
enum class Placement { kCentred, kTopLeft };

/// What a network wants to be shown: one image of fixed size, in planes.
/// A number of the tensor is (pixel - mean) / deviation, pixels being 0..255.
struct InputFormat {
  cv::Size size;
  ChannelOrder order = ChannelOrder::kRgb;
  Placement placement = Placement::kCentred;
  cv::Vec3f mean = {0.0F, 0.0F, 0.0F};             ///< of each channel, in `order`
  cv::Vec3f deviation = {255.0F, 255.0F, 255.0F};  ///< the same
  cv::Vec3f border = {0.0F, 0.0F, 0.0F};           ///< what the tensor holds beside the frame
};

}  // namespace tsg
