#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/geometry/camera_model.hpp"
#include "common/geometry/se3.hpp"

namespace tsg {

/// A textured box with its faces along the axes of the world; a room is one that is seen from
/// inside.
struct Box {
  Eigen::Vector3d min_m;
  Eigen::Vector3d max_m;
  std::uint32_t texture_seed = 0;
  int instance_id = 0;  ///< 0: background
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
};

/// What a camera sees; all images of the camera's size.
struct RoomView {
  cv::Mat colour;  ///< CV_8UC3, BGR
  cv::Mat depth;   ///< CV_16UC1, kSimulatedDepthUnits per metre
  cv::Mat ids;     ///< CV_8UC1, Box::instance_id
};

inline constexpr double kSimulatedDepthUnits = 5000.0;

/// A made-up room with furniture and somebody who walks through it; world axes x right, y down, z
/// forward, metres. Deterministic.
class Room {
 public:
  Room();

  /// The view at a time, without noise; the camera has no distortion.
  [[nodiscard]] RoomView render(const CameraModel& camera,
                                const SE3& T_world_camera,
                                double time_s) const;

  /// Where a person's hand would move the camera; a closed curve of 6 s.
  [[nodiscard]] static SE3 T_world_camera(double time_s);

  /// COCO class of an instance id.
  [[nodiscard]] const std::vector<std::pair<int, std::string>>& classes() const { return classes_; }
  [[nodiscard]] static bool moves(int instance_id);

 private:
  [[nodiscard]] std::vector<Box> boxes_at(double time_s) const;

  std::vector<Box> boxes_;
  std::vector<std::pair<int, std::string>> classes_;
};

}  // namespace tsg
