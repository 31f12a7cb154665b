#include "services/segmentation/lib/decoders/yolo_seg_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/core/check.hpp"
#include "services/segmentation/lib/decoders/finite.hpp"
#include "services/segmentation/lib/decoders/mask_painter.hpp"
#include "services/segmentation/lib/linear_tap.hpp"

namespace tsg {

namespace {

/// The best class of each anchor. Goes through the tensor row by row, as it lies in memory.
struct BestClasses {
  std::vector<float> scores;
  std::vector<int> class_ids;
};

BestClasses best_classes(const YoloSegLayout& layout, std::span<const float> anchors) {
  const auto count = static_cast<std::size_t>(layout.anchors);
  BestClasses best{std::vector<float>(count, 0.0F), std::vector<int>(count, 0)};
  const float* scores = anchors.data() + static_cast<std::size_t>(kBoxNumbers) * count;
  for (int class_id = 0; class_id < layout.classes(); ++class_id, scores += count) {
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_better = scores[i] > best.scores[i];
      best.scores[i] = is_better ? scores[i] : best.scores[i];
      best.class_ids[i] = is_better ? class_id : best.class_ids[i];
    }
  }
  return best;
}

cv::Rect2f box_of_anchor(std::span<const float> anchors, std::size_t count, std::size_t anchor) {
  const float centre_x = anchors[anchor];
  const float centre_y = anchors[count + anchor];
  const float width = anchors[2 * count + anchor];
  const float height = anchors[3 * count + anchor];
  return {centre_x - width / 2, centre_y - height / 2, width, height};
}

float intersection_over_union(const cv::Rect2f& a, const cv::Rect2f& b) {
  const float shared = (a & b).area();
  return shared / (a.area() + b.area() - shared);
}

/// Keeps of each class the best of every heap of boxes. `detections` by falling score.
std::vector<YoloSegDetection> without_duplicates(const std::vector<YoloSegDetection>& detections,
                                                 float max_iou) {
  std::vector<YoloSegDetection> kept;
  for (const auto& detection : detections) {
    const bool is_duplicate = std::any_of(kept.begin(), kept.end(), [&](const auto& better) {
      return better.class_id == detection.class_id &&
             intersection_over_union(better.input_box, detection.input_box) > max_iou;
    });
    if (!is_duplicate) kept.push_back(detection);
  }
  return kept;
}

std::vector<float> coefficients_of(const MaskContext& context, int anchor) {
  const YoloSegLayout& layout = context.layout;
  const auto count = static_cast<std::size_t>(layout.anchors);
  const auto first = static_cast<std::size_t>(kBoxNumbers + layout.classes());
  std::vector<float> coefficients(static_cast<std::size_t>(layout.coefficients));
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    coefficients[i] =
        context.tensors.anchors[(first + i) * count + static_cast<std::size_t>(anchor)];
  }
  return coefficients;
}

/// Probability of the mask at each prototype pixel of `region`.
cv::Mat_<float> mask_probabilities(const MaskContext& context,
                                   const std::vector<float>& coefficients,
                                   const cv::Rect& region) {
  const cv::Size size = context.layout.prototype_size;
  cv::Mat_<float> mask(region.size(), 0.0F);
  for (int y = 0; y < region.height; ++y) {
    auto* row = mask.ptr<float>(y);
    const float* prototype = context.tensors.prototypes.data() +
                             static_cast<std::ptrdiff_t>(region.y + y) * size.width + region.x;
    for (const float coefficient : coefficients) {
      for (int x = 0; x < region.width; ++x) row[x] += coefficient * prototype[x];
      prototype += size.area();
    }
    for (int x = 0; x < region.width; ++x) row[x] = 1.0F / (1.0F + std::exp(-row[x]));
  }
  return mask;
}

/// Where the frame pixels first, first + 1, ... are sampled among the prototypes.
std::vector<MaskTap> prototype_taps(int first, int count, double scale, double offset, int length) {
  constexpr double kPrototypesPerInputPixel = 0.25;
  std::vector<MaskTap> taps(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double input = (first + i + 0.5) * scale + offset;
    taps[static_cast<std::size_t>(i)] =
        mask_tap(linear_tap(input * kPrototypesPerInputPixel - 0.5, length));
  }
  return taps;
}

/// Whole pixels that a box, not empty and inside the frame, touches.
cv::Rect pixels_of_box(const cv::Rect2f& box, cv::Size frame_size) {
  const int min_x = static_cast<int>(box.x);
  const int min_y = static_cast<int>(box.y);
  const int end_x = std::min(static_cast<int>(box.br().x) + 1, frame_size.width);
  const int end_y = std::min(static_cast<int>(box.br().y) + 1, frame_size.height);
  return {min_x, min_y, end_x - min_x, end_y - min_y};
}

/// The prototypes that the sampling takes, which are as many as its taps reach.
cv::Rect prototypes_of(const MaskSampling& sampling, cv::Size prototypes) {
  const cv::Point first(sampling.columns.front().first, sampling.rows.front().first);
  const cv::Point end(std::min(sampling.columns.back().first + 2, prototypes.width),
                      std::min(sampling.rows.back().first + 2, prototypes.height));
  return {first, end};
}

}  // namespace

Expected<std::vector<YoloSegDetection>> find_detections(const YoloSegLayout& layout,
                                                        const DecoderConfig& config,
                                                        const YoloSegTensors& tensors) {
  for (const auto& tensor : {tensors.anchors, tensors.prototypes}) {
    if (auto finite = check_finite(tensor); !finite) return tl::unexpected(finite.error());
  }
  const BestClasses best = best_classes(layout, tensors.anchors);
  std::vector<YoloSegDetection> candidates;
  for (std::size_t i = 0; i < best.scores.size(); ++i) {
    if (!(best.scores[i] > static_cast<float>(config.score_threshold))) continue;
    const cv::Rect2f box = box_of_anchor(tensors.anchors, best.scores.size(), i);
    if (!(box.width > 0.0F && box.height > 0.0F)) continue;
    candidates.push_back({static_cast<int>(i), best.class_ids[i], best.scores[i], box});
  }
  // Stable: of equal scores the first anchor wins, whatever the library's sort does.
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  return without_duplicates(candidates, static_cast<float>(config.nms_iou));
}

void paint_detection(const MaskContext& context,
                     const YoloSegDetection& detection,
                     std::uint8_t label,
                     cv::Mat& labels) {
  const Letterbox& letterbox = context.letterbox;
  const cv::Size prototypes = context.layout.prototype_size;
  const cv::Rect2f box = letterbox.to_frame(detection.input_box);
  if (box.empty()) return;  // beside the frame
  const cv::Rect pixels = pixels_of_box(box, letterbox.frame_size);
  const MaskSampling sampling{.pixels = pixels,
                              .columns = prototype_taps(pixels.x, pixels.width, letterbox.scale_x,
                                                        letterbox.image.x, prototypes.width),
                              .rows = prototype_taps(pixels.y, pixels.height, letterbox.scale_y,
                                                     letterbox.image.y, prototypes.height)};
  const cv::Rect region = prototypes_of(sampling, prototypes);
  const MaskPart mask{
      mask_probabilities(context, coefficients_of(context, detection.anchor), region), region.tl()};
  paint_mask(mask, sampling, pixels, label, labels);
}

Expected<DecodedInstances> YoloSegDecoder::decode(std::span<const TensorView> outputs,
                                                  const Letterbox& letterbox,
                                                  cv::Mat& labels) const {
  const YoloSegTensors tensors{.anchors = outputs[0].floats, .prototypes = outputs[1].floats};
  const MaskContext context{layout_, tensors, letterbox};
  auto detections = find_detections(layout_, config_, tensors);
  if (!detections) return tl::unexpected(detections.error());
  DecodedInstances decoded;
  if (detections->size() > kMaxInstances) {
    decoded.left_out = static_cast<int>(detections->size()) - kMaxInstances;
    detections->resize(kMaxInstances);
  }
  labels.create(letterbox.frame_size, CV_8UC1);
  labels.setTo(0);
  for (std::size_t i = detections->size(); i > 0; --i) {  // the best last, on top
    paint_detection(context, (*detections)[i - 1], static_cast<std::uint8_t>(i), labels);
  }
  for (const auto& detection : *detections) {
    decoded.instances.push_back(
        {.class_name = layout_.class_names[static_cast<std::size_t>(detection.class_id)],
         .score = detection.score,
         .box = letterbox.to_frame(detection.input_box)});
  }
  return decoded;
}

YoloSegDecoder::YoloSegDecoder(YoloSegLayout layout, const DecoderConfig& config)
    : layout_(std::move(layout)), config_(config) {
  constexpr float kBorder = 114.0F / 255.0F;  // the grey that these networks are trained with
  format_ = {.size = layout_.input_size, .border = cv::Vec3f::all(kBorder)};
}

}  // namespace tsg
