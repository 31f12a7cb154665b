#include "services/segmentation/lib/yolo_seg_decoder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/core/check.hpp"
#include "services/segmentation/lib/linear_tap.hpp"

namespace tsg {

namespace {

/// False where any value is NaN or infinite: those have all bits of the exponent set.
bool is_all_finite(std::span<const float> values) {
  constexpr std::uint32_t kExponent = 0x7F800000U;
  std::uint32_t found = 0;
  for (const float value : values) {
    found |=
        static_cast<std::uint32_t>((std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent);
  }
  return found == 0;
}

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
std::vector<LinearTap> prototype_taps(
    int first, int count, double scale, double offset, int length) {
  constexpr double kPrototypesPerInputPixel = 0.25;
  std::vector<LinearTap> taps(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double input = (first + i + 0.5) * scale + offset;
    taps[static_cast<std::size_t>(i)] = linear_tap(input * kPrototypesPerInputPixel - 0.5, length);
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

/// Writes `label` where the interpolation of two mask rows along `columns` is above one half.
/// `columns` index whole prototype rows; `mask` begins at the first of them.
void paint_row(std::span<const float> blended,
               const std::vector<LinearTap>& columns,
               std::uint8_t label,
               std::uint8_t* labels) {
  const int first = columns.front().first;
  for (std::size_t x = 0; x < columns.size(); ++x) {
    const LinearTap& tap = columns[x];
    const float left = blended[static_cast<std::size_t>(tap.first - first)];
    const float right = blended[static_cast<std::size_t>(tap.second - first)];
    const float probability = left + (right - left) * tap.weight_of_second;
    labels[x] = probability > 0.5F ? label : labels[x];
  }
}

}  // namespace

std::vector<std::string> YoloSegConfig::problems() const {
  std::vector<std::string> found;
  if (!(score_threshold > 0.0 && score_threshold < 1.0)) {
    found.emplace_back("score_threshold must be between 0 and 1");
  }
  if (!(nms_iou > 0.0 && nms_iou <= 1.0)) found.emplace_back("nms_iou must be > 0 and at most 1");
  return found;
}

Expected<std::vector<YoloSegDetection>> find_detections(const YoloSegLayout& layout,
                                                        const YoloSegConfig& config,
                                                        const YoloSegTensors& tensors) {
  if (!is_all_finite(tensors.anchors) || !is_all_finite(tensors.prototypes)) {
    return make_error(ExitCode::kInvalidNumber,
                      "the network's outputs hold NaN or infinity: the model file is damaged or "
                      "was exported in too low a precision; export it anew as float32");
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

void paint_mask(const MaskContext& context,
                const YoloSegDetection& detection,
                std::uint8_t label,
                cv::Mat& labels) {
  const Letterbox& letterbox = context.letterbox;
  const cv::Size prototypes = context.layout.prototype_size;
  const cv::Rect2f box = letterbox.to_frame(detection.input_box);
  if (box.empty()) return;  // beside the frame
  const cv::Rect pixels = pixels_of_box(box, letterbox.frame_size);
  const auto columns = prototype_taps(pixels.x, pixels.width, letterbox.scale_x, letterbox.image.x,
                                      prototypes.width);
  const auto rows = prototype_taps(pixels.y, pixels.height, letterbox.scale_y, letterbox.image.y,
                                   prototypes.height);
  const cv::Rect region(cv::Point(columns.front().first, rows.front().first),
                        cv::Point(columns.back().second + 1, rows.back().second + 1));
  const cv::Mat_<float> mask =
      mask_probabilities(context, coefficients_of(context, detection.anchor), region);
  std::vector<float> blended(static_cast<std::size_t>(region.width));
  for (int y = 0; y < pixels.height; ++y) {
    const LinearTap& tap = rows[static_cast<std::size_t>(y)];
    const auto* upper = mask.ptr<float>(tap.first - region.y);
    const auto* lower = mask.ptr<float>(tap.second - region.y);
    for (std::size_t x = 0; x < blended.size(); ++x) {
      blended[x] = upper[x] + (lower[x] - upper[x]) * tap.weight_of_second;
    }
    paint_row(blended, columns, label, labels.ptr<std::uint8_t>(pixels.y + y) + pixels.x);
  }
}

Expected<DecodedInstances> decode_yolo_seg(const MaskContext& context,
                                           const YoloSegConfig& config,
                                           cv::Mat& labels) {
  auto detections = find_detections(context.layout, config, context.tensors);
  if (!detections) return tl::unexpected(detections.error());
  DecodedInstances decoded;
  if (detections->size() > kMaxInstances) {
    decoded.left_out = static_cast<int>(detections->size()) - kMaxInstances;
    detections->resize(kMaxInstances);
  }
  labels.create(context.letterbox.frame_size, CV_8UC1);
  labels.setTo(0);
  for (std::size_t i = detections->size(); i > 0; --i) {  // the best last, on top
    paint_mask(context, (*detections)[i - 1], static_cast<std::uint8_t>(i), labels);
  }
  for (const auto& detection : *detections) {
    decoded.instances.push_back(
        {.class_name = context.layout.class_names[static_cast<std::size_t>(detection.class_id)],
         .score = detection.score,
         .box = context.letterbox.to_frame(detection.input_box)});
  }
  return decoded;
}

}  // namespace tsg
