#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "services/segmentation/lib/linear_tap.hpp"

namespace tsg {

/// How a frame is placed in a network's input: scaled with its aspect ratio kept and centred, the
/// rest filled with grey. Coordinates are continuous: the first pixel covers 0..1.
struct Letterbox {
  cv::Size frame_size;
  cv::Size input_size;
  cv::Rect image;        ///< the part of the input that shows the frame
  double scale_x = 1.0;  ///< input pixels per frame pixel; image.width / frame_size.width
  double scale_y = 1.0;

  /// A box in frame pixels from one in input pixels, cut to the frame.
  [[nodiscard]] cv::Rect2f to_frame(const cv::Rect2f& input_box) const;
};

[[nodiscard]] Letterbox make_letterbox(cv::Size frame_size, cv::Size input_size);

/// Converts frames to input tensors of a network: scaling (bilinear), BGR to RGB, 0..255 to 0..1
/// and pixels to planes, in one pass without intermediate images. Keeps the tables for scaling,
/// so one object serves one owner.
class InputTensorWriter {
 public:
  explicit InputTensorWriter(const Letterbox& letterbox);

  /// `bgr` has the letterbox's frame size; `tensor` holds 3 planes of its input size (R, G, B).
  void write(const cv::Mat& bgr, std::span<float> tensor) const;

  [[nodiscard]] const Letterbox& letterbox() const { return letterbox_; }

 private:
  void fill_border(float* plane) const;
  void write_row_scaled(const cv::Mat& bgr, int row, std::span<float> tensor) const;

  Letterbox letterbox_;
  std::vector<LinearTap> columns_;
  std::vector<LinearTap> rows_;
};

}  // namespace tsg
