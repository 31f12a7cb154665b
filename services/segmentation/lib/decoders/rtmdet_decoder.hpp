#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "services/segmentation/lib/decoders/rtmdet_layout.hpp"
#include "services/segmentation/lib/instance_decoder.hpp"

namespace tsg {

/// Instances of an RTMDet-Ins network. Where a mask of those that are found has a number outside
/// 0..1, all are taken for logits.
class RtmdetDecoder final : public InstanceDecoder {
 public:
  RtmdetDecoder(RtmdetLayout layout, const DecoderConfig& config);

  [[nodiscard]] std::string layout_name() const override { return "RTMDet-Ins"; }
  [[nodiscard]] const InputFormat& input_format() const override { return format_; }
  [[nodiscard]] const std::vector<std::string>& class_names() const override {
    return layout_.class_names;
  }
  [[nodiscard]] Expected<DecodedInstances> decode(std::span<const TensorView> outputs,
                                                  const Letterbox& letterbox,
                                                  cv::Mat& labels) const override;

 private:
  RtmdetLayout layout_;
  DecoderConfig config_;
  InputFormat format_;
};

}  // namespace tsg
