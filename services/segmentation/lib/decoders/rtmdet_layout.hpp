#pragma once

#include <cstddef>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/segmentation/lib/decoders/class_names.hpp"
#include "services/segmentation/lib/model_description.hpp"

namespace tsg {

/// An RTMDet-Ins network (Lyu et al., "RTMDet", 2022) with its NMS inside, of N detections, which
/// may differ from run to run; the outputs in any order:
///   dets    float32 [1, N, 5]      left, top, right, bottom (input pixels), score
///   labels  int64   [1, N]         class
///   masks   float32 [1, N, H, W]   at input resolution: probabilities, 0 or 1, or logits
struct RtmdetLayout {
  cv::Size input_size;
  std::size_t boxes = 0;  ///< index of the output
  std::size_t classes = 0;
  std::size_t masks = 0;
  std::vector<std::string> class_names;
};

/// The layout of `model`; kUnsupportedModel, saying what differs, where it is not that of
/// RTMDet-Ins. How many classes there are does not show in it.
[[nodiscard]] Expected<RtmdetLayout> rtmdet_layout(const ModelDescription& model,
                                                   const ClassNames& names);

}  // namespace tsg
