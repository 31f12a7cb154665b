#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "services/segmentation/lib/input_format.hpp"
#include "services/segmentation/lib/linear_tap.hpp"

namespace tsg {

/// How a frame is placed in a network's input: scaled with its aspect ratio kept, beside it a
/// border of one colour. Coordinates are continuous: the first pixel covers 0..1.
struct Letterbox {
  cv::Size frame_size;
  cv::Size input_size;
  cv::Rect image;        ///< the part of the input that shows the frame
  double scale_x = 1.0;  ///< input pixels per frame pixel; image.width / frame_size.width
  double scale_y = 1.0;

  /// A box in frame pixels from one in input pixels, cut to the frame.
  [[nodiscard]] cv::Rect2f to_frame(const cv::Rect2f& input_box) const;
};

[[nodiscard]] Letterbox make_letterbox(cv::Size frame_size,
                                       cv::Size input_size,
                                       Placement placement = Placement::kCentred);

/// Converts frames to input tensors of a network: scaling (bilinear), order of channels, mean and
/// deviation, pixels to planes, in one pass without intermediate images. Keeps the tables for
/// scaling, so one object serves one owner.
class InputTensorWriter {
 public:
  /// For frames of `frame_size`.
  InputTensorWriter(cv::Size frame_size, const InputFormat& format);

  /// `bgr` has that size; `tensor` holds 3 planes of the format's size.
  void write(const cv::Mat& bgr, std::span<float> tensor) const;

  [[nodiscard]] const Letterbox& letterbox() const { return letterbox_; }

 private:
  /// Where a channel of the frame goes, and how: number = pixel * scale + offset.
  struct Channel {
    std::size_t plane = 0;  ///< index of its first number in the tensor
    float scale = 1.0F;
    float offset = 0.0F;
    float border = 0.0F;
  };

  void fill_border(const Channel& channel, std::span<float> tensor) const;
  void write_row(const cv::Mat& bgr, int row, std::span<float> tensor) const;
  void write_row_scaled(const cv::Mat& bgr, int row, std::span<float> tensor) const;

  Letterbox letterbox_;
  std::array<Channel, 3> channels_;  ///< blue, green, red, as in the frame
  std::vector<LinearTap> columns_;
  std::vector<LinearTap> rows_;
};

}  // namespace tsg
