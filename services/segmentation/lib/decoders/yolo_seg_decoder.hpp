#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/segmentation/lib/decoders/yolo_seg_layout.hpp"
#include "services/segmentation/lib/instance_decoder.hpp"
#include "services/segmentation/lib/letterbox.hpp"

namespace tsg {

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

/// Detections above the score threshold that no better one of the same class covers, by falling
/// score. kInvalidNumber where the outputs hold NaN or infinity.
[[nodiscard]] Expected<std::vector<YoloSegDetection>> find_detections(
    const YoloSegLayout& layout, const DecoderConfig& config, const YoloSegTensors& tensors);

/// Where a network's outputs lie in a frame.
struct MaskContext {
  const YoloSegLayout& layout;
  const YoloSegTensors& tensors;
  const Letterbox& letterbox;
};

/// Writes `label` into `labels` (CV_8UC1, frame size) wherever the detection's mask is:
/// sigmoid(coefficients . prototypes), interpolated bilinearly to frame pixels, above one half,
/// inside its box (whole pixels, both ends included).
void paint_detection(const MaskContext& context,
                     const YoloSegDetection& detection,
                     std::uint8_t label,
                     cv::Mat& labels);

/// Instances of a YOLOv8/11-seg network.
class YoloSegDecoder final : public InstanceDecoder {
 public:
  YoloSegDecoder(YoloSegLayout layout, const DecoderConfig& config);

  [[nodiscard]] std::string layout_name() const override { return "YOLOv8/11-seg"; }
  [[nodiscard]] const InputFormat& input_format() const override { return format_; }
  [[nodiscard]] const std::vector<std::string>& class_names() const override {
    return layout_.class_names;
  }
  [[nodiscard]] Expected<DecodedInstances> decode(std::span<const TensorView> outputs,
                                                  const Letterbox& letterbox,
                                                  cv::Mat& labels) const override;

 private:
  YoloSegLayout layout_;
  DecoderConfig config_;
  InputFormat format_;
};

}  // namespace tsg
