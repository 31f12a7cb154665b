#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tsg {

/// A mask as bits, and how many are set.
struct BitMask {
  std::vector<std::uint64_t> words;
  int area = 0;
};

/// Bits of the samples that are above zero.
[[nodiscard]] BitMask mask_above_zero(std::span<const float> samples);

/// A mask of one class.
struct ClassMask {
  const BitMask* mask = nullptr;  ///< not empty
  int class_id = 0;
};

/// Matrix NMS with a Gaussian (SOLOv2, section 3.3): by what factor the score of each mask is to
/// shrink for those of its class before it that it overlaps. `masks` come by falling score.
///   decay_j = min_i exp(-sigma (iou_ij^2 - max_k iou_ki^2)), i < j, k < i
[[nodiscard]] std::vector<float> matrix_nms(std::span<const ClassMask> masks, float sigma);

}  // namespace tsg
