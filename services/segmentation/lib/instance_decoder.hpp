#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/rgbd/instances.hpp"
#include "services/segmentation/lib/input_format.hpp"
#include "services/segmentation/lib/letterbox.hpp"
#include "services/segmentation/lib/model_description.hpp"

namespace tsg {

struct DecoderConfig {
  double score_threshold = 0.25;  // below it COCO networks are wrong more often than right
  double nms_iou = 0.6;           // two people side by side overlap by less; YOLO-seg only

  [[nodiscard]] std::vector<std::string> problems() const;
};

struct DecodedInstances {
  std::vector<Instance> instances;  ///< by falling score, boxes in frame pixels
  int left_out = 0;                 ///< detections beyond kMaxInstances
};

/// How networks of one layout are shown a frame, and what their outputs mean. Immutable.
class InstanceDecoder {
 public:
  InstanceDecoder() = default;
  virtual ~InstanceDecoder() = default;
  InstanceDecoder(const InstanceDecoder&) = delete;
  InstanceDecoder& operator=(const InstanceDecoder&) = delete;
  InstanceDecoder(InstanceDecoder&&) = delete;
  InstanceDecoder& operator=(InstanceDecoder&&) = delete;

  /// "SOLOv2, 11 raw outputs".
  [[nodiscard]] virtual std::string layout_name() const = 0;
  [[nodiscard]] virtual const InputFormat& input_format() const = 0;
  [[nodiscard]] virtual const std::vector<std::string>& class_names() const = 0;

  /// Turns the outputs of a run, in the order of the model's description, into instances and their
  /// label image (CV_8UC1, frame size, made or reused): where masks overlap, the higher score wins.
  /// A mask may be empty or wholly covered; its instance is kept. At most kMaxInstances, the best.
  /// kInvalidNumber where an output holds NaN or infinity, kUnsupportedModel where it has another
  /// shape or class than the model's description allows.
  [[nodiscard]] virtual Expected<DecodedInstances> decode(std::span<const TensorView> outputs,
                                                          const Letterbox& letterbox,
                                                          cv::Mat& labels) const = 0;
};

}  // namespace tsg
