#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/geometry/camera_model.hpp"
#include "common/geometry/se3.hpp"
#include "common/render/stage.hpp"

namespace tsg::render {

/// Where the camera is while it takes one picture.
struct Shot {
  SE3 T_world_camera;  ///< middle of the exposure, middle row
  SE3 T_world_open;    ///< the camera when its shutter opens
  SE3 T_world_close;   ///< and when it closes: for the motion of pixels in between
  /// Poses of the first and of the last row where rows are read one after the other; both equal to
  /// T_world_camera for a global shutter.
  SE3 T_world_first_row;
  SE3 T_world_last_row;

  /// A camera that does not move.
  [[nodiscard]] static Shot still(const SE3& T_world_camera) {
    return {T_world_camera, T_world_camera, T_world_camera, T_world_camera, T_world_camera};
  }
};

/// What an ideal camera sees; all images of its size.
struct Picture {
  cv::Mat radiance;       ///< CV_32FC3, BGR, linear light: 1 = a white wall in good light
  cv::Mat depth_m;        ///< CV_32FC1, along the optical axis; 0 where there is nothing
  cv::Mat facing;         ///< CV_32FC1, cosine between surface normal and line of sight
  cv::Mat tags;           ///< CV_16UC1, Part::tag
  cv::Mat returns_depth;  ///< CV_8UC1, 255 where an infrared sensor gets an echo
  cv::Mat motion_px;      ///< CV_32FC2, how far the pixel's surface moves while the shutter is open
};

/// Renders a stage for one camera. Pixel centres are whole numbers, lens distortion is the
/// camera's; edges are supersampled. Deterministic; uses all cores. Not thread-safe: buffers are
/// used again from picture to picture.
class Renderer {
 public:
  explicit Renderer(const CameraModel& camera);

  /// Lights up what is seen and paints it.
  [[nodiscard]] Picture render(Stage& stage, const Shot& shot);

 private:
  class Frame;

  CameraModel camera_;
  std::vector<Eigen::Vector3f> directions_;  ///< of each pixel in camera axes, z = 1
  std::vector<Sighting> sightings_;          ///< of each pixel
  std::vector<Eigen::Vector3f> normals_;     ///< of each pixel that sees something
};

}  // namespace tsg::render
