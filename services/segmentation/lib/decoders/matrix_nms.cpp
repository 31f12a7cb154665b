#include "services/segmentation/lib/decoders/matrix_nms.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace tsg {

namespace {

float intersection_over_union(const BitMask& a, const BitMask& b) {
  int shared = 0;
  for (std::size_t i = 0; i < a.words.size(); ++i) shared += std::popcount(a.words[i] & b.words[i]);
  return static_cast<float>(shared) / static_cast<float>(a.area + b.area - shared);
}

}  // namespace

BitMask mask_above_zero(std::span<const float> samples) {
  constexpr std::size_t kBits = 64;
  BitMask mask{std::vector<std::uint64_t>((samples.size() + kBits - 1) / kBits, 0), 0};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    mask.words[i / kBits] |= static_cast<std::uint64_t>(samples[i] > 0.0F) << (i % kBits);
  }
  for (const std::uint64_t word : mask.words) mask.area += std::popcount(word);
  return mask;
}

std::vector<float> matrix_nms(std::span<const ClassMask> masks, float sigma) {
  std::vector<float> decay(masks.size(), 1.0F);
  std::vector<float> most_covered(masks.size(), 0.0F);  // largest overlap with a better one
  for (std::size_t j = 1; j < masks.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (masks[i].class_id != masks[j].class_id) continue;
      const float iou = intersection_over_union(*masks[i].mask, *masks[j].mask);
      most_covered[j] = std::max(most_covered[j], iou);
      const float exponent = iou * iou - most_covered[i] * most_covered[i];
      decay[j] = std::min(decay[j], std::exp(-sigma * exponent));
    }
  }
  return decay;
}

}  // namespace tsg
