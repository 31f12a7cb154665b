#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace tsg {

/// Pinhole camera with the radial-tangential distortion of OpenCV. Pixels: x right, y down, the
/// centre of the top left pixel is (0, 0). Camera axes: x right, y down, z forward.
struct CameraModel {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3

  [[nodiscard]] bool is_distorted() const;

  /// Pixel of an undistorted (ideal pinhole) image; `p_camera.z()` must be positive.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& p_camera) const {
    return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
  }
  /// Point at `depth_m` along the optical axis seen at an undistorted pixel (paper eq. 5-6).
  [[nodiscard]] Eigen::Vector3d unproject(const Eigen::Vector2d& pixel, double depth_m) const {
    return {depth_m * (pixel.x() - cx) / fx, depth_m * (pixel.y() - cy) / fy, depth_m};
  }
  [[nodiscard]] bool contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= width - 1 &&
           pixel.y() <= height - 1;
  }

  /// The camera of the same images scaled to another size.
  [[nodiscard]] CameraModel resized(int new_width, int new_height) const;

  /// What makes the model unusable, a sentence each; empty where it is sound.
  [[nodiscard]] std::vector<std::string> problems() const;

  /// For messages: "640x480, fx 525.0 fy 525.0 cx 319.5 cy 239.5", and the distortion if any.
  [[nodiscard]] std::string describe() const;

  bool operator==(const CameraModel&) const = default;
};

}  // namespace tsg
