#pragma once

#include <opencv2/core/mat.hpp>

#include "common/geometry/camera_model.hpp"
#include "common/geometry/se3.hpp"

namespace tsg {

/// Surfaces that the latest mask shows to belong to no thing that may move. What is seen of them in
/// later frames is background still, however close a thing that the mask showed may have come.
class KnownBackground {
 public:
  /// The mask's frame: its depth (CV_32FC1 of cells, metres) from `T_world_camera`, where `things`
  /// (CV_8UC1 of cells) is 0. A ring of one cell around things is left out.
  void note(const cv::Mat& depth, const cv::Mat& things, const SE3& T_world_camera);

  /// The cells (CV_8UC1, 255) of `depth`, taken from `T_world_camera`, that show it. None before
  /// note(). `camera` is that of the cells.
  [[nodiscard]] cv::Mat find(const CameraModel& camera,
                             const cv::Mat& depth,
                             const SE3& T_world_camera) const;

  void move_world(const SE3& T_moved_world) { T_world_camera_ = T_moved_world * T_world_camera_; }
  void clear() { depth_.release(); }

 private:
  cv::Mat depth_;  ///< 0 where it is not known to be background
  SE3 T_world_camera_;
};

}  // namespace tsg
