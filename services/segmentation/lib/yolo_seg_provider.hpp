#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "common/core/error.hpp"
#include "services/segmentation/lib/letterbox.hpp"
#include "services/segmentation/lib/onnx_model.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"
#include "services/segmentation/lib/yolo_seg_decoder.hpp"
#include "services/segmentation/lib/yolo_seg_layout.hpp"

namespace tsg {

struct YoloSegProviderConfig {
  OnnxModelConfig model;
  YoloSegConfig decoder;
};

/// Instances from a YOLO segmentation network in ONNX Runtime.
class YoloSegProvider final : public SegmentationProvider {
 public:
  /// The errors of OnnxModel::load() and yolo_seg_layout().
  static Expected<std::unique_ptr<SegmentationProvider>> make(const YoloSegProviderConfig& config);

  [[nodiscard]] Expected<SegmentationResult> segment(const RgbdFrame& frame) override;
  void cancel() override { model_.cancel(); }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  YoloSegProvider(const YoloSegProviderConfig& config, OnnxModel model, YoloSegLayout layout);

  YoloSegConfig config_;
  std::string name_;
  OnnxModel model_;
  YoloSegLayout layout_;
  std::optional<InputTensorWriter> writer_;  // for frames of the size last seen
  cv::Mat labels_;
};

}  // namespace tsg
