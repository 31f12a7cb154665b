#pragma once

#include <opencv2/core/mat.hpp>

#include "common/geometry/camera_model.hpp"
#include "common/geometry/se3.hpp"

namespace tsg {

/// What another depth image says of a cell.
enum class CellEvidence : std::uint8_t {
  kNone,      ///< not seen there, or hidden behind something
  kSame,      ///< the same surface was there
  kAppeared,  ///< the other image saw through the place where it is: it has come since
};

/// A depth image of cells and where it was taken.
struct DepthView {
  const cv::Mat& depth;  ///< CV_32FC1, metres, 0 = unknown
  SE3 T_world_camera;
};

/// Lays what `now` shows into the view `then` and compares, under the assumption that nothing
/// moves. Writes CellEvidence to `evidence` (CV_8UC1, size of now.depth) where there is any: to be
/// called for several views from the latest to the earliest, as what was there already did not come
/// since. `camera` is that of the cells, `sigma` the standard deviation of inverse depth in 1/m.
void compare_depth(const CameraModel& camera,
                   const DepthView& now,
                   const DepthView& then,
                   double sigma,
                   cv::Mat& evidence);

/// The cells (255) that appeared, without specks smaller than `min_cells`.
[[nodiscard]] cv::Mat appeared_regions(const cv::Mat& evidence, int min_cells);

}  // namespace tsg
