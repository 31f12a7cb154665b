#include "services/segmentation/lib/letterbox.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/core/check.hpp"

namespace tsg {

namespace {

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

Letterbox make_letterbox(cv::Size frame_size, cv::Size input_size, Placement placement) {
  TSG_CHECK(frame_size.area() > 0 && input_size.area() > 0);
  const double scale = std::min(static_cast<double>(input_size.width) / frame_size.width,
                                static_cast<double>(input_size.height) / frame_size.height);
  Letterbox letterbox;
  letterbox.frame_size = frame_size;
  letterbox.input_size = input_size;
  letterbox.image.width = std::max(1, static_cast<int>(std::lround(frame_size.width * scale)));
  letterbox.image.height = std::max(1, static_cast<int>(std::lround(frame_size.height * scale)));
  if (placement == Placement::kCentred) {
    letterbox.image.x = (input_size.width - letterbox.image.width) / 2;
    letterbox.image.y = (input_size.height - letterbox.image.height) / 2;
  }
  // Rounding to whole pixels makes the two scales differ by a little.
  letterbox.scale_x = static_cast<double>(letterbox.image.width) / frame_size.width;
  letterbox.scale_y = static_cast<double>(letterbox.image.height) / frame_size.height;
  return letterbox;
}

InputTensorWriter::InputTensorWriter(cv::Size frame_size, const InputFormat& format)
    : letterbox_(make_letterbox(frame_size, format.size, format.placement)),
      columns_(frame_taps(frame_size.width, letterbox_.image.width)),
      rows_(frame_taps(frame_size.height, letterbox_.image.height)) {
  for (int channel = 0; channel < 3; ++channel) {
    const int place = format.order == ChannelOrder::kRgb ? 2 - channel : channel;
    channels_.at(static_cast<std::size_t>(channel)) = {
        .plane = static_cast<std::size_t>(place) * static_cast<std::size_t>(format.size.area()),
        .scale = 1.0F / format.deviation[place],
        .offset = -format.mean[place] / format.deviation[place],
        .border = format.border[place]};
  }
}

void InputTensorWriter::write(const cv::Mat& bgr, std::span<float> tensor) const {
  TSG_CHECK(bgr.type() == CV_8UC3 && bgr.size() == letterbox_.frame_size);
  TSG_CHECK(tensor.size() == 3 * static_cast<std::size_t>(letterbox_.input_size.area()));
  const cv::Rect& image = letterbox_.image;
  if (image.size() != letterbox_.input_size) {
    for (const Channel& channel : channels_) fill_border(channel, tensor);
  }
  const bool is_scaled = image.size() != letterbox_.frame_size;
  for (int y = 0; y < image.height; ++y) {
    if (is_scaled) {
      write_row_scaled(bgr, y, tensor);
    } else {
      write_row(bgr, y, tensor);
    }
  }
}

void InputTensorWriter::fill_border(const Channel& channel, std::span<float> tensor) const {
  const cv::Size& input = letterbox_.input_size;
  const cv::Rect& image = letterbox_.image;
  for (int y = 0; y < input.height; ++y) {
    float* row = tensor.data() + channel.plane + static_cast<std::ptrdiff_t>(y) * input.width;
    const bool shows_frame = y >= image.y && y < image.br().y;
    std::fill(row, row + (shows_frame ? image.x : input.width), channel.border);
    if (shows_frame) std::fill(row + image.br().x, row + input.width, channel.border);
  }
}

void InputTensorWriter::write_row(const cv::Mat& bgr, int row, std::span<float> tensor) const {
  const auto* pixels = bgr.ptr<std::uint8_t>(row);
  const std::ptrdiff_t first =
      static_cast<std::ptrdiff_t>(letterbox_.image.y + row) * letterbox_.input_size.width +
      letterbox_.image.x;
  const auto [blue, green, red] = channels_;
  float* blues = tensor.data() + blue.plane + first;
  float* greens = tensor.data() + green.plane + first;
  float* reds = tensor.data() + red.plane + first;
  for (int x = 0; x < letterbox_.image.width; ++x) {
    const std::uint8_t* pixel = pixels + static_cast<std::ptrdiff_t>(3) * x;
    blues[x] = static_cast<float>(pixel[0]) * blue.scale + blue.offset;
    greens[x] = static_cast<float>(pixel[1]) * green.scale + green.offset;
    reds[x] = static_cast<float>(pixel[2]) * red.scale + red.offset;
  }
}

void InputTensorWriter::write_row_scaled(const cv::Mat& bgr,
                                         int row,
                                         std::span<float> tensor) const {
  const LinearTap& vertical = rows_[static_cast<std::size_t>(row)];
  const auto* upper = bgr.ptr<std::uint8_t>(vertical.first);
  const auto* lower = bgr.ptr<std::uint8_t>(vertical.second);
  float* first =
      tensor.data() +
      static_cast<std::ptrdiff_t>(letterbox_.image.y + row) * letterbox_.input_size.width +
      letterbox_.image.x;
  for (std::size_t x = 0; x < columns_.size(); ++x) {
    for (int i = 0; i < 3; ++i) {
      const Channel& channel = channels_[static_cast<std::size_t>(i)];
      const float above = interpolate(upper, columns_[x], i);
      const float below = interpolate(lower, columns_[x], i);
      const float value = above + (below - above) * vertical.weight_of_second;
      first[channel.plane + x] = value * channel.scale + channel.offset;
    }
  }
}

}  // namespace tsg
