#include "services/segmentation/lib/decoders/rtmdet_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "services/segmentation/lib/decoders/finite.hpp"
#include "services/segmentation/lib/decoders/mask_painter.hpp"

namespace tsg {

namespace {

constexpr std::size_t kDetectionNumbers = 5;

struct RtmdetDetection {
  std::size_t index = 0;  ///< among the network's
  float score = 0.0F;
};

/// The outputs of one run, checked against each other.
struct Outputs {
  std::span<const float> boxes;
  std::span<const std::int64_t> classes;
  std::span<const float> masks;
};

Expected<Outputs> checked_outputs(const RtmdetLayout& layout, std::span<const TensorView> outputs) {
  const Outputs checked{outputs[layout.boxes].floats, outputs[layout.classes].integers,
                        outputs[layout.masks].floats};
  const std::size_t count = checked.classes.size();
  const auto mask_size = static_cast<std::size_t>(layout.input_size.area());
  if (checked.boxes.size() != count * kDetectionNumbers ||
      checked.masks.size() != count * mask_size) {
    return make_error(ExitCode::kUnsupportedModel,
                      "the network gave " + std::to_string(count) + " labels, but " +
                          std::to_string(checked.boxes.size()) + " numbers of boxes (5 each) and " +
                          std::to_string(checked.masks.size()) + " of masks (" +
                          std::to_string(mask_size) +
                          " each, the input's size); export it with masks of the input's size");
  }
  if (auto finite = check_finite(checked.boxes); !finite) return tl::unexpected(finite.error());
  return checked;
}

std::vector<RtmdetDetection> detections_above(float threshold, std::span<const float> boxes) {
  std::vector<RtmdetDetection> detections;
  for (std::size_t i = 0; i < boxes.size() / kDetectionNumbers; ++i) {
    const float score = boxes[kDetectionNumbers * i + kDetectionNumbers - 1];
    if (score > threshold) detections.push_back({i, score});
  }
  std::stable_sort(detections.begin(), detections.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  return detections;
}

Expected<void> check_classes(const RtmdetLayout& layout,
                             std::span<const RtmdetDetection> detections,
                             std::span<const std::int64_t> classes) {
  const auto known = static_cast<std::int64_t>(layout.class_names.size());
  for (const RtmdetDetection& detection : detections) {
    const std::int64_t class_id = classes[detection.index];
    if (class_id >= 0 && class_id < known) continue;
    return make_error(ExitCode::kUnsupportedModel,
                      "the network found class " + std::to_string(class_id) + ", but only " +
                          std::to_string(known) +
                          " classes have names; give all with segmentation.model.labels");
  }
  return {};
}

cv::Rect2f box_of(std::span<const float> boxes, std::size_t index) {
  const float* box = boxes.data() + kDetectionNumbers * index;
  return {cv::Point2f(box[0], box[1]), cv::Point2f(box[2], box[3])};
}

/// The masks of `detections`. Others are not looked at: networks that always give a hundred
/// detections, most of them empty, have masks of 160 MB at 640 x 640.
Expected<std::vector<std::span<const float>>> masks_of(std::span<const RtmdetDetection> detections,
                                                       std::span<const float> masks,
                                                       std::size_t mask_length) {
  std::vector<std::span<const float>> chosen;
  for (const RtmdetDetection& detection : detections) {
    chosen.push_back(masks.subspan(detection.index * mask_length, mask_length));
    if (auto finite = check_finite(chosen.back()); !finite) return tl::unexpected(finite.error());
  }
  return chosen;
}

bool are_logits(std::span<const std::span<const float>> masks) {
  return std::any_of(masks.begin(), masks.end(), [](std::span<const float> mask) {
    const auto [least, most] = std::minmax_element(mask.begin(), mask.end());
    return *least < 0.0F || *most > 1.0F;
  });
}

/// A mask of probabilities from one of these or of logits.
cv::Mat_<float> probabilities(cv::Size size, std::span<const float> mask, bool of_logits) {
  cv::Mat_<float> made(size);
  const auto probability = [&](float value) {
    return of_logits ? 1.0F / (1.0F + std::exp(-value)) : value;
  };
  std::transform(mask.begin(), mask.end(), made.begin(), probability);
  return made;
}

}  // namespace

RtmdetDecoder::RtmdetDecoder(RtmdetLayout layout, const DecoderConfig& config)
    : layout_(std::move(layout)), config_(config) {
  format_ = {.size = layout_.input_size,
             .order = ChannelOrder::kBgr,
             .placement = Placement::kTopLeft,
             .mean = {103.53F, 116.28F, 123.675F},
             .deviation = {57.375F, 57.12F, 58.395F}};
  for (int i = 0; i < 3; ++i) {  // padded with grey, before normalisation
    format_.border[i] = (114.0F - format_.mean[i]) / format_.deviation[i];
  }
}

Expected<DecodedInstances> RtmdetDecoder::decode(std::span<const TensorView> outputs,
                                                 const Letterbox& letterbox,
                                                 cv::Mat& labels) const {
  const auto found = checked_outputs(layout_, outputs);
  if (!found) return tl::unexpected(found.error());
  auto detections = detections_above(static_cast<float>(config_.score_threshold), found->boxes);
  if (auto known = check_classes(layout_, detections, found->classes); !known) {
    return tl::unexpected(known.error());
  }
  DecodedInstances decoded;
  if (detections.size() > kMaxInstances) {
    decoded.left_out = static_cast<int>(detections.size()) - kMaxInstances;
    detections.resize(kMaxInstances);
  }
  const auto masks =
      masks_of(detections, found->masks, static_cast<std::size_t>(layout_.input_size.area()));
  if (!masks) return tl::unexpected(masks.error());
  labels.create(letterbox.frame_size, CV_8UC1);
  labels.setTo(0);
  const bool of_logits = are_logits(*masks);
  const MaskSampling sampling = sample_whole_frame(letterbox, 1, layout_.input_size);
  for (std::size_t i = detections.size(); i > 0; --i) {  // the best last, on top
    paint_mask(probabilities(layout_.input_size, (*masks)[i - 1], of_logits), sampling,
               static_cast<std::uint8_t>(i), labels);
  }
  for (const RtmdetDetection& detection : detections) {
    const auto class_id = static_cast<std::size_t>(found->classes[detection.index]);
    decoded.instances.push_back({.class_name = layout_.class_names[class_id],
                                 .score = detection.score,
                                 .box = letterbox.to_frame(box_of(found->boxes, detection.index))});
  }
  return decoded;
}

}  // namespace tsg
