#include "services/segmentation/lib/decoders/solov2_decoder.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "services/segmentation/lib/decoders/finite.hpp"
#include "services/segmentation/lib/decoders/mask_painter.hpp"
#include "services/segmentation/lib/decoders/matrix_nms.hpp"
#include "services/segmentation/lib/decoders/sigmoid.hpp"
#include "services/segmentation/lib/decoders/solov2_cells.hpp"

namespace tsg {

namespace {

// Of the published configuration of SOLOv2.
constexpr std::size_t kMaxBeforeNms = 500;
constexpr std::size_t kMaxAfterNms = 100;
constexpr float kSigma = 2.0F;
constexpr float kMinScoreAfterNms = 0.05F;
constexpr int kMaskStep = 4;  // pixels of the input for each sample of a mask

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A cell's mask, which all of its classes share.
struct CellMask {
  int level = 0;
  int cell = 0;
  BitMask bits;
  float mean_probability = 0.0F;  ///< of the samples inside
};

struct Solov2Detection {
  const CellMask* mask = nullptr;
  int class_id = 0;
  float score = 0.0F;
};

/// The products of kernels and features.
class MaskMaker {
 public:
  MaskMaker(const Solov2Layout& layout,
            std::span<const Solov2Level> levels,
            std::span<const float> feature)
      : levels_(levels), feature_(feature.data(), layout.kernel_length, layout.mask_size.area()) {}

  /// Logits of the masks of `cells`, one in each row.
  [[nodiscard]] Matrix logits(std::span<const CellMask* const> cells) const {
    Matrix kernels(static_cast<Eigen::Index>(cells.size()), feature_.rows());
    for (Eigen::Index row = 0; row < kernels.rows(); ++row) {
      const CellMask& cell = *cells[static_cast<std::size_t>(row)];
      const Solov2Level& level = levels_[static_cast<std::size_t>(cell.level)];
      const float* kernel = level.kernels + cell.cell * level.between_cells_of_kernels;
      for (Eigen::Index i = 0; i < kernels.cols(); ++i) {
        kernels(row, i) = kernel[i * level.between_numbers];
      }
    }
    return kernels * feature_;
  }

 private:
  std::span<const Solov2Level> levels_;
  Eigen::Map<const Matrix> feature_;
};

float mean_probability_inside(std::span<const float> logits, int area) {
  if (area == 0) return 0.0F;
  double sum = 0.0;
  for (const float logit : logits) {
    if (logit > 0.0F) sum += sigmoid(logit);
  }
  return static_cast<float>(sum / area);
}

/// The masks of all cells that have a candidate, in their order. The matrix of logits is made in
/// parts: a network that finds something in each cell would need hundreds of megabytes.
std::vector<CellMask> masks_of_cells(std::span<const Solov2Candidate> candidates,
                                     const MaskMaker& maker) {
  constexpr std::size_t kAtOnce = 64;
  std::vector<CellMask> masks;
  for (const Solov2Candidate& candidate : candidates) {
    const bool is_known = !masks.empty() && masks.back().cell == candidate.cell &&
                          masks.back().level == candidate.level;
    if (!is_known) masks.push_back({candidate.level, candidate.cell, {}, 0.0F});
  }
  for (std::size_t begin = 0; begin < masks.size(); begin += kAtOnce) {
    std::vector<const CellMask*> part;
    const std::size_t end = std::min(begin + kAtOnce, masks.size());
    for (std::size_t i = begin; i < end; ++i) part.push_back(&masks[i]);
    const Matrix logits = maker.logits(part);
    for (std::size_t i = begin; i < end; ++i) {
      const std::span<const float> row(logits.row(static_cast<Eigen::Index>(i - begin)).data(),
                                       static_cast<std::size_t>(logits.cols()));
      masks[i].bits = mask_above_zero(row);
      masks[i].mean_probability = mean_probability_inside(row, masks[i].bits.area);
    }
  }
  return masks;
}

void sort_by_score(std::vector<Solov2Detection>& detections) {
  // Stable: of equal scores the finer grid's first cell wins.
  std::stable_sort(detections.begin(), detections.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
}

/// Candidates with masks that are large enough for their grid, by falling score.
std::vector<Solov2Detection> detections_before_nms(std::span<const Solov2Candidate> candidates,
                                                   std::span<const CellMask> masks,
                                                   std::span<const Solov2Level> levels) {
  std::vector<Solov2Detection> detections;
  auto mask = masks.begin();
  for (const Solov2Candidate& candidate : candidates) {
    while (mask->cell != candidate.cell || mask->level != candidate.level) ++mask;
    if (mask->bits.area <= levels[static_cast<std::size_t>(candidate.level)].stride) continue;
    detections.push_back({&*mask, candidate.class_id, candidate.score * mask->mean_probability});
  }
  sort_by_score(detections);
  if (detections.size() > kMaxBeforeNms) detections.resize(kMaxBeforeNms);
  return detections;
}

std::vector<Solov2Detection> after_nms(std::vector<Solov2Detection> detections,
                                       float score_threshold) {
  std::vector<ClassMask> masks;
  masks.reserve(detections.size());
  for (const Solov2Detection& detection : detections) {
    masks.push_back({&detection.mask->bits, detection.class_id});
  }
  const std::vector<float> decay = matrix_nms(masks, kSigma);
  for (std::size_t i = 0; i < detections.size(); ++i) detections[i].score *= decay[i];
  sort_by_score(detections);
  if (detections.size() > kMaxAfterNms) detections.resize(kMaxAfterNms);
  const auto end =
      std::find_if(detections.begin(), detections.end(), [&](const Solov2Detection& d) {
        return d.score < kMinScoreAfterNms || !(d.score > score_threshold);
      });
  detections.erase(end, detections.end());
  return detections;
}

/// Paints the masks of `detections`, the first on top; the box of each.
std::vector<cv::Rect> paint(std::span<const Solov2Detection> detections,
                            const MaskMaker& maker,
                            const Letterbox& letterbox,
                            cv::Mat& labels) {
  std::vector<const CellMask*> cells;
  cells.reserve(detections.size());
  for (const Solov2Detection& detection : detections) cells.push_back(detection.mask);
  Matrix probabilities = maker.logits(cells);
  probabilities = probabilities.unaryExpr([](float logit) { return sigmoid(logit); });
  const cv::Size size = letterbox.input_size / kMaskStep;
  const MaskSampling sampling = sample_whole_frame(letterbox, kMaskStep, size);
  std::vector<cv::Rect> boxes(detections.size());
  for (std::size_t i = detections.size(); i > 0; --i) {
    float* row = probabilities.row(static_cast<Eigen::Index>(i - 1)).data();
    boxes[i - 1] = paint_mask(cv::Mat_<float>(size.height, size.width, row), sampling,
                              static_cast<std::uint8_t>(i), labels);
  }
  return boxes;
}

Expected<void> check_all_finite(std::span<const TensorView> outputs) {
  for (const TensorView& output : outputs) {
    if (auto finite = check_finite(output.floats); !finite) return finite;
  }
  return {};
}

}  // namespace

Solov2Decoder::Solov2Decoder(Solov2Layout layout, const DecoderConfig& config)
    : layout_(std::move(layout)), config_(config) {
  format_ = {.size = layout_.input_size,
             .order = ChannelOrder::kRgb,
             .placement = Placement::kTopLeft,
             .mean = {123.675F, 116.28F, 103.53F},  // of ImageNet, on which the backbones learnt
             .deviation = {58.395F, 57.12F, 57.375F},
             .border = {0.0F, 0.0F, 0.0F}};  // padded after normalisation
}

Expected<DecodedInstances> Solov2Decoder::decode(std::span<const TensorView> outputs,
                                                 const Letterbox& letterbox,
                                                 cv::Mat& labels) const {
  if (auto finite = check_all_finite(outputs); !finite) return tl::unexpected(finite.error());
  const auto levels = solov2_levels(layout_, outputs);
  const MaskMaker maker(layout_, levels, outputs[layout_.feature].floats);
  const auto candidates = find_candidates(layout_, levels);
  const auto masks = masks_of_cells(candidates, maker);
  auto detections = after_nms(detections_before_nms(candidates, masks, levels),
                              static_cast<float>(config_.score_threshold));
  DecodedInstances decoded;
  if (detections.size() > kMaxInstances) {
    decoded.left_out = static_cast<int>(detections.size()) - kMaxInstances;
    detections.resize(kMaxInstances);
  }
  labels.create(letterbox.frame_size, CV_8UC1);
  labels.setTo(0);
  const auto boxes = paint(detections, maker, letterbox, labels);
  for (std::size_t i = 0; i < detections.size(); ++i) {
    decoded.instances.push_back(
        {.class_name = layout_.class_names[static_cast<std::size_t>(detections[i].class_id)],
         .score = detections[i].score,
         .box = cv::Rect2f(boxes[i])});
  }
  return decoded;
}

}  // namespace tsg
