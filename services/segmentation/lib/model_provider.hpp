#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "common/core/error.hpp"
#include "services/segmentation/lib/instance_decoder.hpp"
#include "services/segmentation/lib/letterbox.hpp"
#include "services/segmentation/lib/onnx_model.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"

namespace tsg {

struct ModelProviderConfig {
  OnnxModelConfig model;
  DecoderConfig decoder;
  std::string labels_file = {};  // class names; empty: those in the model's metadata
};

/// Instances from a network in ONNX Runtime, of any layout that make_decoder() knows.
class ModelProvider final : public SegmentationProvider {
 public:
  /// The errors of OnnxModel::load(), read_labels_file() and make_decoder().
  static Expected<std::unique_ptr<ModelProvider>> make(const ModelProviderConfig& config);

  [[nodiscard]] Expected<SegmentationResult> segment(const RgbdFrame& frame) override;
  void cancel() override { model_.cancel(); }
  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] const ModelDescription& description() const { return model_.description(); }
  [[nodiscard]] const InstanceDecoder& decoder() const { return *decoder_; }

 private:
  ModelProvider(std::string name, OnnxModel model, std::unique_ptr<InstanceDecoder> decoder);

  std::string name_;
  OnnxModel model_;
  std::unique_ptr<InstanceDecoder> decoder_;
  std::optional<InputTensorWriter> writer_;  // for frames of the size last seen
  cv::Mat labels_;
};

}  // namespace tsg
