#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/geometry/camera_model.hpp"
#include "common/rgbd/rgbd_frame.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

inline constexpr int kSurfaceCell = 6;  ///< pixels between neighbouring cells of a Surface

/// What the depth image shows of things that stand still, one sample a cell.
struct Surface {
  int columns = 0;
  int rows = 0;
  std::vector<float> inverse_depths;  ///< 1/m, row by row; 0 where nothing usable was seen

  [[nodiscard]] std::size_t index(int column, int row) const {
    const int cell = row * columns + column;
    return static_cast<std::size_t>(cell);
  }
  [[nodiscard]] float at(int column, int row) const { return inverse_depths[index(column, row)]; }
};

/// Samples the depth image. `verdicts` is empty or has a FeatureVerdict per pixel; cells on
/// kDynamic pixels are left out.
[[nodiscard]] Surface sample_surface(const RgbdFrame& frame,
                                     const cv::Mat& verdicts,
                                     const FeatureConfig& config);

/// A sample in space, with the plane that its neighbours lie in.
struct SurfacePatch {
  Eigen::Vector3d point;   ///< camera, metres
  Eigen::Vector3d normal;  ///< camera, unit, towards the camera
};

/// One for each cell of a Surface.
class PatchGrid {
 public:
  PatchGrid(const CameraModel& camera, const Surface& surface, const FeatureConfig& config);

  /// The patch seen at an undistorted pixel, or so many cells beside it; null where there is none.
  [[nodiscard]] const SurfacePatch* find(const Eigen::Vector2d& pixel,
                                         int columns_beside = 0,
                                         int rows_beside = 0) const;
  [[nodiscard]] const std::vector<SurfacePatch>& patches() const { return patches_; }

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<SurfacePatch> patches_;
  std::vector<int> patch_of_cell_;  ///< index, or -1
};

}  // namespace tsg
