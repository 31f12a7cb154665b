#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "services/segmentation/lib/letterbox.hpp"
#include "services/segmentation/lib/linear_tap.hpp"

namespace tsg {

/// Where a frame's column or row is sampled in a mask: samples next to each other, from `first` on,
/// with weights that add up to one. Three are what two linear interpolations after another take.
struct MaskTap {
  int first = 0;
  std::array<float, 3> weights = {1.0F, 0.0F, 0.0F};
};

[[nodiscard]] MaskTap mask_tap(const LinearTap& tap);

/// How the pixels of a part of a frame are sampled in a mask.
struct MaskSampling {
  cv::Rect pixels;               ///< of the frame
  std::vector<MaskTap> columns;  ///< of pixels.x, pixels.x + 1, ...; `first` never falls
  std::vector<MaskTap> rows;     ///< of pixels.y, pixels.y + 1, ...

  /// The pixels that the mask's samples in `samples` have a part in.
  [[nodiscard]] cv::Rect pixels_touching(const cv::Rect& samples) const;
};

/// How the whole frame is sampled in a mask that has one sample for each `step` x `step` pixels of
/// a network's input. As networks' own tools do it: the mask is enlarged by `step` (bilinear), what
/// lies beside the image is cut off, and the rest is scaled to the frame (bilinear).
[[nodiscard]] MaskSampling sample_whole_frame(const Letterbox& letterbox,
                                              int step,
                                              cv::Size mask_size);

/// A part of a mask of probabilities.
struct MaskPart {
  cv::Mat_<float> values;
  cv::Point origin = {0, 0};  ///< which sample of the whole mask values(0, 0) is
};

/// Writes `label` into `labels` (CV_8UC1, frame size) at those of `pixels`, a part of the
/// sampling's, where the mask is above one half; `mask` holds all samples that these need. Returns
/// the smallest rectangle around what it wrote.
cv::Rect paint_mask(const MaskPart& mask,
                    const MaskSampling& sampling,
                    const cv::Rect& pixels,
                    std::uint8_t label,
                    cv::Mat& labels);

/// The same with a whole mask, at all pixels of the sampling.
cv::Rect paint_mask(const cv::Mat_<float>& mask,
                    const MaskSampling& sampling,
                    std::uint8_t label,
                    cv::Mat& labels);

}  // namespace tsg
