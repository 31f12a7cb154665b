#include "services/slam/lib/patch_blur.hpp"

#include <algorithm>
#include <cstddef>
#include <opencv2/core/hal/intrin.hpp>

#include "common/core/check.hpp"

namespace tsg {
namespace {

constexpr int kRadius = 3;
/// Of the middle pixel and those 1, 2 and 3 beside it; 256 in sum over all seven.
constexpr std::array<int, kRadius + 1> kWeights{56, 48, 34, 18};
/// Sums along x need 16 bits without a sign; products of numbers with one are faster.
constexpr int kOffset = 32768;

/// Of -3, -2, -1 for instance the mirror images 3, 2, 1.
int mirrored(int i, int size) {
  if (i < 0) return -i;
  return i < size ? i : 2 * (size - 1) - i;
}

std::int16_t along_y(const std::array<const std::int16_t*, 2 * kRadius + 1>& rows, std::size_t x) {
  int sum = 0;
  for (std::size_t tap = 0; tap < rows.size(); ++tap) {
    const std::size_t distance = tap < kRadius ? kRadius - tap : tap - kRadius;
    sum += kWeights[distance] * (rows[tap][x] + kOffset);
  }
  return static_cast<std::int16_t>((sum + kOffset) >> 16);
}

/// Eight pixels at once; the same as along_y().
cv::v_int16x8 along_y_8(const std::array<const std::int16_t*, 2 * kRadius + 1>& rows,
                        std::size_t x) {
  // Two rows a product. The offsets of all rows and half a unit, to round:
  const cv::v_int32x4 rounding = cv::v_setall_s32(256 * kOffset + kOffset);
  cv::v_int32x4 low = rounding;
  cv::v_int32x4 high = rounding;
  const auto add = [&](std::size_t first, std::size_t second, int weight, int weight_2) {
    cv::v_int16x8 a;
    cv::v_int16x8 b;
    cv::v_zip(cv::v_load(rows[first] + x), cv::v_load(rows[second] + x), a, b);
    const cv::v_int16x8 weights =
        cv::v_reinterpret_as_s16(cv::v_setall_s32(weight | weight_2 * 65536));
    low = cv::v_dotprod(a, weights, low);
    high = cv::v_dotprod(b, weights, high);
  };
  add(0, 6, kWeights[3], kWeights[3]);
  add(1, 5, kWeights[2], kWeights[2]);
  add(2, 4, kWeights[1], kWeights[1]);
  add(3, 3, kWeights[0], 0);
  return cv::v_pack(low >> 16, high >> 16);
}

}  // namespace

void PatchBlur::blur_row(const cv::Mat& image, int row) {
  const auto* from = image.ptr<std::uint8_t>(mirrored(row, image.rows));
  std::copy_n(from, image.cols, padded_.begin() + kRadius);
  for (int i = 1; i <= kRadius; ++i) {
    padded_[static_cast<std::size_t>(kRadius - i)] = from[i];
    padded_[static_cast<std::size_t>(kRadius + image.cols - 1 + i)] = from[image.cols - 1 - i];
  }
  const std::uint8_t* pixel = padded_.data();
  std::int16_t* sums = rows_[static_cast<std::size_t>(row + kRadius) % kTaps].data();
  for (std::size_t x = 0; x < static_cast<std::size_t>(image.cols); ++x) {
    const int sum = kWeights[0] * pixel[x + 3] + kWeights[1] * (pixel[x + 2] + pixel[x + 4]) +
                    kWeights[2] * (pixel[x + 1] + pixel[x + 5]) +
                    kWeights[3] * (pixel[x] + pixel[x + 6]);
    sums[x] = static_cast<std::int16_t>(sum - kOffset);
  }
}

void PatchBlur::blur(const cv::Mat& image, cv::Mat& blurred) {
  TSG_CHECK(image.type() == CV_8UC1 && image.cols > kRadius && image.rows > kRadius);
  blurred.create(image.size(), CV_8UC1);
  const auto width = static_cast<std::size_t>(image.cols);
  padded_.resize(width + 2 * kRadius);
  for (auto& row : rows_) row.resize(width);
  for (int row = -kRadius; row < kRadius; ++row) blur_row(image, row);
  for (int y = 0; y < image.rows; ++y) {
    blur_row(image, y + kRadius);
    std::array<const std::int16_t*, kTaps> rows{};
    for (std::size_t tap = 0; tap < rows.size(); ++tap) {
      rows[tap] = rows_[(static_cast<std::size_t>(y) + tap) % kTaps].data();
    }
    auto* to = blurred.ptr<std::uint8_t>(y);
    std::size_t x = 0;
    for (; x + 8 <= width; x += 8) cv::v_pack_u_store(to + x, along_y_8(rows, x));
    for (; x < width; ++x) to[x] = static_cast<std::uint8_t>(along_y(rows, x));
  }
}

}  // namespace tsg
