#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "services/segmentation/lib/decoders/solov2_layout.hpp"
#include "services/segmentation/lib/instance_decoder.hpp"

namespace tsg {

/// Instances of a SOLOv2 network: what its head does after the convolutions, on the CPU. Masks are
/// computed for cells only that have a class.
class Solov2Decoder final : public InstanceDecoder {
 public:
  Solov2Decoder(Solov2Layout layout, const DecoderConfig& config);

  [[nodiscard]] std::string layout_name() const override {
    return layout_.is_merged ? "SOLOv2, merged outputs" : "SOLOv2, 11 raw outputs";
  }
  [[nodiscard]] const InputFormat& input_format() const override { return format_; }
  [[nodiscard]] const std::vector<std::string>& class_names() const override {
    return layout_.class_names;
  }
  [[nodiscard]] Expected<DecodedInstances> decode(std::span<const TensorView> outputs,
                                                  const Letterbox& letterbox,
                                                  cv::Mat& labels) const override;

 private:
  Solov2Layout layout_;
  DecoderConfig config_;
  InputFormat format_;
};

}  // namespace tsg
