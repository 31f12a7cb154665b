#include "common/render/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/core/check.hpp"

namespace tsg::render {
namespace {

constexpr int kMaxSide = 4096;

bool is_side(int pixels) {
  return pixels >= 1 && pixels <= kMaxSide && (pixels & (pixels - 1)) == 0;
}

/// Linear light of each sRGB code (IEC 61966-2-1).
std::array<float, 256> make_linear_table() {
  std::array<float, 256> table{};
  for (std::size_t code = 0; code < table.size(); ++code) {
    const double value = static_cast<double>(code) / 255.0;
    const double light = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    table.at(code) = static_cast<float>(light);
  }
  return table;
}

Eigen::Vector3f linear_light(const cv::Vec3b& code) {
  static const std::array<float, 256> kLinear = make_linear_table();
  return {kLinear[code[0]], kLinear[code[1]], kLinear[code[2]]};
}

}  // namespace

Texture::Texture(const cv::Mat& image) {
  TSG_CHECK(image.type() == CV_8UC3 && is_side(image.cols) && is_side(image.rows));
  levels_.push_back(image.clone());
  while (levels_.back().cols > 1 && levels_.back().rows > 1) {
    cv::Mat half;
    cv::resize(levels_.back(), half, {}, 0.5, 0.5, cv::INTER_AREA);
    levels_.push_back(half);
  }
}

Eigen::Vector3f Texture::sample(const Eigen::Vector2f& uv, float footprint) const {
  const float pixels = footprint * static_cast<float>(levels_.front().rows);
  const float level = std::log2(std::max(pixels, 1.0F));
  const auto finest = static_cast<int>(level);
  const int last = static_cast<int>(levels_.size()) - 1;
  if (finest >= last) return sample_level(last, uv);
  // Levels are mixed around the middle between them only: nobody sees the difference.
  const float share = std::clamp(2.0F * (level - static_cast<float>(finest)) - 0.5F, 0.0F, 1.0F);
  if (share <= 0.0F) return sample_level(finest, uv);
  if (share >= 1.0F) return sample_level(finest + 1, uv);
  return (1.0F - share) * sample_level(finest, uv) + share * sample_level(finest + 1, uv);
}

Eigen::Vector3f Texture::sample_level(int level, const Eigen::Vector2f& uv) const {
  const cv::Mat& image = levels_[static_cast<std::size_t>(level)];
  const float x = (uv.x() - std::floor(uv.x())) * static_cast<float>(image.cols) - 0.5F;
  const float y = (uv.y() - std::floor(uv.y())) * static_cast<float>(image.rows) - 0.5F;
  const float x_floor = std::floor(x);
  const float y_floor = std::floor(y);
  // Sides are powers of two, so that a mask wraps around, below zero too.
  const int x0 = static_cast<int>(x_floor) & (image.cols - 1);
  const int y0 = static_cast<int>(y_floor) & (image.rows - 1);
  const int x1 = (x0 + 1) & (image.cols - 1);
  const int y1 = (y0 + 1) & (image.rows - 1);
  const float right = x - x_floor;
  const float below = y - y_floor;
  const auto* const upper = image.ptr<cv::Vec3b>(y0);
  const auto* const lower = image.ptr<cv::Vec3b>(y1);
  return (1.0F - below) *
             ((1.0F - right) * linear_light(upper[x0]) + right * linear_light(upper[x1])) +
         below * ((1.0F - right) * linear_light(lower[x0]) + right * linear_light(lower[x1]));
}

}  // namespace tsg::render
