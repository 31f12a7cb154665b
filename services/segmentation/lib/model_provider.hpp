#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/core/error.hpp"
#include "services/segmentation/lib/instance_decoder.hpp"
#include "services/segmentation/lib/instance_tracker.hpp"
#include "services/segmentation/lib/letterbox.hpp"
#include "services/segmentation/lib/model_file.hpp"
#include "services/segmentation/lib/onnx_model.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"

namespace tsg {

struct ModelProviderConfig {
  OnnxModelConfig model;
  DecoderConfig decoder;
  std::string labels_file = {};  // class names; empty: those in the model's metadata
};

/// Instances from a network in ONNX Runtime, of any layout that make_decoder() knows, followed from
/// frame to frame. The network is the one that the file held at the start.
class ModelProvider final : public SegmentationProvider {
 public:
  /// The errors of OnnxModel::load(), read_labels_file() and make_decoder().
  static Expected<std::unique_ptr<ModelProvider>> make(const ModelProviderConfig& config);

  [[nodiscard]] Expected<SegmentationResult> segment(const RgbdFrame& frame,
                                                     cv::Mat& labels) override;
  void cancel() override { model_.cancel(); }
  [[nodiscard]] const std::string& name() const override { return name_; }
  /// Tells of a provider of the runtime that is not used though it was asked for, and of a model
  /// file that is no longer the one that was loaded.
  [[nodiscard]] ProviderState state() override;

  [[nodiscard]] const ModelDescription& description() const { return model_.description(); }
  [[nodiscard]] const InstanceDecoder& decoder() const { return *decoder_; }

 private:
  ModelProvider(const ModelFile& file, OnnxModel model, std::unique_ptr<InstanceDecoder> decoder);

  std::string name_;
  ModelFile file_;
  OnnxModel model_;
  std::unique_ptr<InstanceDecoder> decoder_;
  std::optional<InputTensorWriter> writer_;  // for frames of the size last seen
  InstanceTracker tracker_;
};

}  // namespace tsg
