#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/rgbd/instances.hpp"
#include "services/segmentation/lib/letterbox.hpp"
#include "services/segmentation/lib/yolo_seg_layout.hpp"

namespace tsg {

struct YoloSegConfig {
  double score_threshold = 0.25;  // below it COCO networks are wrong more often than right
  double nms_iou = 0.6;           // two people side by side overlap by less

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// The outputs of a network for one frame, with the shapes that its layout says.
struct YoloSegTensors {
  std::span<const float> anchors;     ///< [4 + C + M, A]
  std::span<const float> prototypes;  ///< [M, H / 4, W / 4]
};

/// One object that the network found.
struct YoloSegDetection {
  int anchor = 0;
  int class_id = 0;
  float score = 0.0F;
  cv::Rect2f input_box;  ///< pixels of the network's input, may reach beyond it
};

struct DecodedInstances {
  std::vector<Instance> instances;  ///< by falling score, boxes in frame pixels
  int left_out = 0;                 ///< detections beyond kMaxInstances
};

/// Detections above the score threshold that no better one of the same class covers, by falling
/// score. kInvalidNumber where the outputs hold NaN or infinity.
[[nodiscard]] Expected<std::vector<YoloSegDetection>> find_detections(
    const YoloSegLayout& layout, const YoloSegConfig& config, const YoloSegTensors& tensors);

/// Where a network's outputs lie in a frame.
struct MaskContext {
  const YoloSegLayout& layout;
  const YoloSegTensors& tensors;
  const Letterbox& letterbox;
};

/// Writes `label` into `labels` (CV_8UC1, frame size) wherever the detection's mask is:
/// sigmoid(coefficients . prototypes), interpolated bilinearly to frame pixels, above one half,
/// inside its box (whole pixels, both ends included).
void paint_mask(const MaskContext& context,
                const YoloSegDetection& detection,
                std::uint8_t label,
                cv::Mat& labels);

/// Turns the outputs of a network into instances and their label image (CV_8UC1, frame size, made
/// or reused): where masks overlap, the higher score wins. A mask may be empty or wholly covered;
/// its instance is kept. At most kMaxInstances, the best.
[[nodiscard]] Expected<DecodedInstances> decode_yolo_seg(const MaskContext& context,
                                                         const YoloSegConfig& config,
                                                         cv::Mat& labels);

}  // namespace tsg
