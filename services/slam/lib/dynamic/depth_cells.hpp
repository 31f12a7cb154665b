#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "common/geometry/camera_model.hpp"
#include "common/rgbd/rgbd_frame.hpp"

namespace tsg {

/// Motion is judged on cells of so many pixels a side: fine enough for a limb, a sixteenth of the
/// work.
inline constexpr int kCellSide = 4;

/// Pixel in the middle of a cell.
[[nodiscard]] inline cv::Point pixel_of_cell(int column, int row) {
  return {column * kCellSide + kCellSide / 2, row * kCellSide + kCellSide / 2};
}

/// Cell that an undistorted pixel lies in; may be outside the image.
[[nodiscard]] cv::Point cell_at(const Eigen::Vector2d& pixel);

/// The camera that has one pixel for each cell of `camera`.
[[nodiscard]] CameraModel camera_of_cells(const CameraModel& camera);

/// Depth of each cell in metres (CV_32FC1), 0 where there is none: the nearest of its inner four
/// pixels, as what moves usually stands in front.
[[nodiscard]] cv::Mat depth_of_cells(const RgbdFrame& frame);

/// An image of `size` with the value of its cell (CV_8UC1) at each pixel; of the nearest one where
/// the image is no whole number of cells.
[[nodiscard]] cv::Mat pixels_of_cells(const cv::Mat& cells, const cv::Size& size);

/// Which cells flow into a region of cells.
struct GrowLimits {
  float nearest = 0.0F;   ///< metres
  float farthest = 0.0F;  ///< metres
  int steps = 0;          ///< cells
};

/// Marks (255) what `depth` shows to be connected to the marked cells (CV_8UC1).
void grow_over_surface(const cv::Mat& depth, const GrowLimits& limits, cv::Mat& marked);

}  // namespace tsg
