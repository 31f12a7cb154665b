#include "services/segmentation/lib/letterbox.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/core/check.hpp"

namespace tsg {

namespace {

constexpr float kOneOver255 = 1.0F / 255.0F;
constexpr float kBorder = 114.0F * kOneOver255;  // the grey that YOLO networks are trained with

/// One row of pixels to one row of each plane, without scaling.
void write_row(const std::uint8_t* bgr, int width, float* red, float* green, float* blue) {
  for (int x = 0; x < width; ++x) {
    const std::uint8_t* pixel = bgr + static_cast<std::ptrdiff_t>(3) * x;
    blue[x] = static_cast<float>(pixel[0]) * kOneOver255;
    green[x] = static_cast<float>(pixel[1]) * kOneOver255;
    red[x] = static_cast<float>(pixel[2]) * kOneOver255;
  }
}

/// One channel of a row of pixels, between two of them.
float interpolate(const std::uint8_t* bgr, const LinearTap& tap, int channel) {
  const auto left = static_cast<float>(bgr[3 * tap.first + channel]);
  const auto right = static_cast<float>(bgr[3 * tap.second + channel]);
  return left + (right - left) * tap.weight_of_second;
}

/// For each pixel along the image in the input, where it is sampled in the frame.
std::vector<LinearTap> frame_taps(int frame_length, int image_length) {
  const double scale = static_cast<double>(image_length) / frame_length;
  std::vector<LinearTap> taps(static_cast<std::size_t>(image_length));
  for (std::size_t i = 0; i < taps.size(); ++i) {
    taps[i] = linear_tap((static_cast<double>(i) + 0.5) / scale - 0.5, frame_length);
  }
  return taps;
}

}  // namespace

cv::Rect2f Letterbox::to_frame(const cv::Rect2f& input_box) const {
  const cv::Rect2d box(input_box);
  const double width = frame_size.width;
  const double height = frame_size.height;
  const cv::Point2d min(std::clamp((box.x - image.x) / scale_x, 0.0, width),
                        std::clamp((box.y - image.y) / scale_y, 0.0, height));
  const cv::Point2d max(std::clamp((box.br().x - image.x) / scale_x, 0.0, width),
                        std::clamp((box.br().y - image.y) / scale_y, 0.0, height));
  return cv::Rect2d(min, max);
}

Letterbox make_letterbox(cv::Size frame_size, cv::Size input_size) {
  TSG_CHECK(frame_size.area() > 0 && input_size.area() > 0);
  const double scale = std::min(static_cast<double>(input_size.width) / frame_size.width,
                                static_cast<double>(input_size.height) / frame_size.height);
  Letterbox letterbox;
  letterbox.frame_size = frame_size;
  letterbox.input_size = input_size;
  letterbox.image.width = std::max(1, static_cast<int>(std::lround(frame_size.width * scale)));
  letterbox.image.height = std::max(1, static_cast<int>(std::lround(frame_size.height * scale)));
  letterbox.image.x = (input_size.width - letterbox.image.width) / 2;
  letterbox.image.y = (input_size.height - letterbox.image.height) / 2;
  // Rounding to whole pixels makes the two scales differ by a little.
  letterbox.scale_x = static_cast<double>(letterbox.image.width) / frame_size.width;
  letterbox.scale_y = static_cast<double>(letterbox.image.height) / frame_size.height;
  return letterbox;
}

InputTensorWriter::InputTensorWriter(const Letterbox& letterbox)
    : letterbox_(letterbox),
      columns_(frame_taps(letterbox.frame_size.width, letterbox.image.width)),
      rows_(frame_taps(letterbox.frame_size.height, letterbox.image.height)) {}

void InputTensorWriter::write(const cv::Mat& bgr, std::span<float> tensor) const {
  const auto plane = static_cast<std::size_t>(letterbox_.input_size.area());
  TSG_CHECK(bgr.type() == CV_8UC3 && bgr.size() == letterbox_.frame_size);
  TSG_CHECK(tensor.size() == 3 * plane);
  const cv::Rect& image = letterbox_.image;
  if (image.size() != letterbox_.input_size) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      fill_border(tensor.data() + channel * plane);
    }
  }
  const bool is_scaled = image.size() != letterbox_.frame_size;
  for (int y = 0; y < image.height; ++y) {
    if (is_scaled) {
      write_row_scaled(bgr, y, tensor);
      continue;
    }
    float* red = tensor.data() +
                 static_cast<std::ptrdiff_t>(image.y + y) * letterbox_.input_size.width + image.x;
    write_row(bgr.ptr<std::uint8_t>(y), image.width, red, red + plane, red + 2 * plane);
  }
}

void InputTensorWriter::fill_border(float* plane) const {
  const cv::Size& input = letterbox_.input_size;
  const cv::Rect& image = letterbox_.image;
  for (int y = 0; y < input.height; ++y) {
    float* row = plane + static_cast<std::ptrdiff_t>(y) * input.width;
    const bool shows_frame = y >= image.y && y < image.br().y;
    std::fill(row, row + (shows_frame ? image.x : input.width), kBorder);
    if (shows_frame) std::fill(row + image.br().x, row + input.width, kBorder);
  }
}

void InputTensorWriter::write_row_scaled(const cv::Mat& bgr,
                                         int row,
                                         std::span<float> tensor) const {
  const cv::Size& input = letterbox_.input_size;
  const LinearTap& vertical = rows_[static_cast<std::size_t>(row)];
  const auto* upper = bgr.ptr<std::uint8_t>(vertical.first);
  const auto* lower = bgr.ptr<std::uint8_t>(vertical.second);
  const auto plane = static_cast<std::size_t>(input.area());
  float* red = tensor.data() + static_cast<std::ptrdiff_t>(letterbox_.image.y + row) * input.width +
               letterbox_.image.x;
  for (std::size_t x = 0; x < columns_.size(); ++x) {
    for (int channel = 0; channel < 3; ++channel) {
      const float above = interpolate(upper, columns_[x], channel);
      const float below = interpolate(lower, columns_[x], channel);
      const float value = above + (below - above) * vertical.weight_of_second;
      red[static_cast<std::size_t>(2 - channel) * plane + x] = value * kOneOver255;
    }
  }
}

}  // namespace tsg
