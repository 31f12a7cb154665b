#include "services/segmentation/lib/decoders/matrix_nms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tsg {
namespace {

/// A mask of samples first..last of a row of 130.
BitMask mask_of(int first, int last) {
  std::vector<float> samples(130, -1.0F);
  for (int i = first; i <= last; ++i) samples[static_cast<std::size_t>(i)] = 0.5F;
  return mask_above_zero(samples);
}

TEST(BitMask, HasTheSamplesAboveZero) {
  const BitMask mask = mask_of(60, 129);
  EXPECT_EQ(mask.area, 70);
  ASSERT_EQ(mask.words.size(), 3U);
  EXPECT_EQ(mask.words[0], std::uint64_t{0xF} << 60U);
  EXPECT_EQ(mask.words[2], 0b11U);
  EXPECT_EQ(mask_above_zero(std::vector<float>{0.0F}).area, 0);
}

TEST(MatrixNms, ShrinksByTheOverlapWithABetterOneOfTheClass) {
  const BitMask better = mask_of(0, 99);
  const BitMask worse = mask_of(50, 99);  // an IoU of one half
  const std::vector<ClassMask> masks{{&better, 1}, {&worse, 1}};
  const std::vector<float> decay = matrix_nms(masks, 2.0F);
  EXPECT_FLOAT_EQ(decay[0], 1.0F);
  EXPECT_FLOAT_EQ(decay[1], std::exp(-2.0F * 0.25F));
}

TEST(MatrixNms, LeavesOtherClassesAndOtherPlacesAlone) {
  const BitMask here = mask_of(0, 49);
  const BitMask there = mask_of(50, 99);
  const std::vector<ClassMask> masks{{&here, 1}, {&here, 2}, {&there, 1}};
  for (const float decay : matrix_nms(masks, 2.0F)) EXPECT_FLOAT_EQ(decay, 1.0F);
}

TEST(MatrixNms, CountsLessWhatIsItselfCovered) {
  const BitMask best = mask_of(0, 99);
  const BitMask covered = mask_of(0, 89);  // an IoU of 0.9 with the best
  const BitMask last = mask_of(45, 89);    // of 0.45 with the best, of 0.5 with the covered one
  const std::vector<ClassMask> masks{{&best, 1}, {&covered, 1}, {&last, 1}};
  EXPECT_FLOAT_EQ(matrix_nms(masks, 2.0F)[2], std::exp(-2.0F * 0.45F * 0.45F));
}

}  // namespace
}  // namespace tsg
