#pragma once

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/segmentation/lib/decoders/class_names.hpp"
#include "services/segmentation/lib/model_description.hpp"

namespace tsg {

/// Numbers per anchor that make its box.
inline constexpr int kBoxNumbers = 4;

/// A YOLOv8/11-seg network as its exporter lays it out:
///   input   [1, 3, H, W]           RGB, 0..1
///   first   [1, 4 + C + M, A]      per anchor: centre x, centre y, width, height (input pixels),
///                                  C class scores (0..1), M mask coefficients
///   second  [1, M, H / 4, W / 4]   mask prototypes
struct YoloSegLayout {
  cv::Size input_size;
  cv::Size prototype_size;
  int anchors = 0;
  int coefficients = 0;
  std::vector<std::string> class_names;

  [[nodiscard]] int classes() const { return static_cast<int>(class_names.size()); }
};

/// The layout of `model`; kUnsupportedModel, saying what differs and how to export, where it is not
/// that of a YOLO segmentation network, and the error of check_class_count().
[[nodiscard]] Expected<YoloSegLayout> yolo_seg_layout(const ModelDescription& model,
                                                      const ClassNames& names);

}  // namespace tsg
