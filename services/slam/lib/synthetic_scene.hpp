#pragma once

// For tests: a scene whose every pose, depth and mask is known exactly.

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "common/geometry/camera_model.hpp"
#include "common/geometry/se3.hpp"
#include "common/rgbd/instances.hpp"
#include "common/rgbd/rgbd_frame.hpp"
#include "services/slam/lib/observation_model.hpp"

namespace tsg::synthetic {

inline constexpr std::int64_t kFramePeriodNs = 33'333'333;
inline constexpr double kDepthUnits = 5000.0;

inline CameraModel camera() {
  return {.width = 640, .height = 480, .fx = 525.0, .fy = 525.0, .cx = 319.5, .cy = 239.5};
}

inline SE3 pose_at(double x, double y, double z, double yaw = 0.0) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY())),
          Eigen::Vector3d(x, y, z)};
}

/// A fronto-parallel rectangle with a texture of its own.
struct Panel {
  double z = 0.0;  ///< metres along world z
  Eigen::Vector2d corner;
  Eigen::Vector2d extent;
  unsigned texture_seed = 0;
  std::uint8_t label = 0;  ///< in masks; 0 = none
};

/// Random grey squares of several sizes: corners at all scales.
inline cv::Mat make_texture(unsigned seed, int side = 1200) {
  cv::RNG random(seed);
  cv::Mat texture(side, side, CV_8UC3, cv::Scalar::all(127));
  for (int i = 0; i < 4000; ++i) {
    const int size = random.uniform(6, i < 400 ? 90 : 28);
    const cv::Rect square(random.uniform(-40, side), random.uniform(-40, side), size, size);
    cv::rectangle(texture, square, cv::Scalar::all(random.uniform(0, 256)), cv::FILLED);
  }
  return texture;
}

/// A wall with a board in front of it, seen by a pinhole camera.
class Scene {
 public:
  explicit Scene(std::vector<Panel> panels) : panels_(std::move(panels)) {
    for (const Panel& panel : panels_) textures_.push_back(make_texture(panel.texture_seed));
  }

  static Scene room() {
    return Scene({{.z = 3.0, .corner = {-4.0, -3.0}, .extent = {8.0, 6.0}, .texture_seed = 1},
                  {.z = 2.0, .corner = {-0.9, -0.4}, .extent = {0.8, 1.0}, .texture_seed = 2},
                  {.z = 1.6, .corner = {0.3, -0.2}, .extent = {0.5, 0.6}, .texture_seed = 3}});
  }

  Panel& panel(std::size_t i) { return panels_[i]; }
  void add(const Panel& panel) {
    panels_.push_back(panel);
    textures_.push_back(make_texture(panel.texture_seed));
  }

  /// Panels later in the list cover earlier ones.
  [[nodiscard]] RgbdFrame render(std::uint64_t seq, const SE3& T_world_camera) const {
    RgbdFrame frame{.seq = seq,
                    .stamp_ns = static_cast<std::int64_t>(seq) * kFramePeriodNs,
                    .camera = camera(),
                    .depth_units_per_metre = kDepthUnits,
                    .colour = cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(0)),
                    .depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(0))};
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      const cv::Mat H = texture_to_image(i, T_world_camera);
      cv::Mat coverage;
      cv::Mat image;
      const cv::Mat full(textures_[i].size(), CV_8UC1, cv::Scalar(255));
      cv::warpPerspective(full, coverage, H, frame.colour.size(), cv::INTER_NEAREST);
      cv::warpPerspective(textures_[i], image, H, frame.colour.size(), cv::INTER_LINEAR);
      image.copyTo(frame.colour, coverage);
      fill_depth(panels_[i], T_world_camera, coverage, frame.depth);
    }
    return frame;
  }

  /// The true mask of a frame; labels are those of the panels, instance k has class_names[k].
  [[nodiscard]] InstanceSegmentation mask(const RgbdFrame& frame,
                                          const SE3& T_world_camera,
                                          const std::vector<std::string>& class_names) const {
    InstanceSegmentation mask;
    mask.frame_seq = frame.seq;
    mask.stamp_ns = frame.stamp_ns;
    mask.labels = cv::Mat(480, 640, CV_8UC1, cv::Scalar(0));
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      cv::Mat coverage;
      const cv::Mat full(textures_[i].size(), CV_8UC1, cv::Scalar(255));
      cv::warpPerspective(full, coverage, texture_to_image(i, T_world_camera), mask.labels.size(),
                          cv::INTER_NEAREST);
      mask.labels.setTo(panels_[i].label, coverage);
    }
    for (const std::string& name : class_names) {
      mask.instances.push_back({.class_name = name, .score = 0.9F, .box = {}});
    }
    return mask;
  }

 private:
  [[nodiscard]] cv::Mat texture_to_image(std::size_t i, const SE3& T_world_camera) const {
    const Panel& panel = panels_[i];
    const CameraModel model = camera();
    const SE3 T_camera_world = T_world_camera.inverse();
    const Eigen::Matrix3d R = T_camera_world.rotation_matrix();
    const double side = textures_[i].cols;
    Eigen::Matrix3d to_camera;  // texture pixel (u, v, 1) -> camera coordinates
    to_camera.col(0) = R.col(0) * panel.extent.x() / side;
    to_camera.col(1) = R.col(1) * panel.extent.y() / side;
    to_camera.col(2) =
        T_camera_world * Eigen::Vector3d(panel.corner.x(), panel.corner.y(), panel.z);
    Eigen::Matrix3d K;
    K << model.fx, 0.0, model.cx, 0.0, model.fy, model.cy, 0.0, 0.0, 1.0;
    const Eigen::Matrix3d H = K * to_camera;
    cv::Mat result(3, 3, CV_64F);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) result.at<double>(row, column) = H(row, column);
    }
    return result;
  }

  static void fill_depth(const Panel& panel,
                         const SE3& T_world_camera,
                         const cv::Mat& coverage,
                         cv::Mat& depth) {
    const CameraModel model = camera();
    for (int y = 0; y < depth.rows; ++y) {
      for (int x = 0; x < depth.cols; ++x) {
        if (coverage.at<std::uint8_t>(y, x) == 0) continue;
        const Eigen::Vector3d ray =
            T_world_camera.rotation() * model.unproject({x, y}, 1.0);  // one metre of depth long
        const double metres = (panel.z - T_world_camera.translation().z()) / ray.z();
        depth.at<std::uint16_t>(y, x) = cv::saturate_cast<std::uint16_t>(metres * kDepthUnits);
      }
    }
  }

  std::vector<Panel> panels_;
  std::vector<cv::Mat> textures_;
};

/// Points between 1 and 5 m in front of the world's origin.
inline std::vector<Eigen::Vector3d> random_points(std::mt19937& generator, std::size_t count) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Eigen::Vector3d> points;
  while (points.size() < count) {
    const double z = 1.0 + 4.0 * unit(generator);
    points.emplace_back((unit(generator) - 0.5) * z, (unit(generator) - 0.5) * 0.8 * z, z);
  }
  return points;
}

/// The exact sighting of a point, as ObservationModel weighs level-0 features.
inline PointObservation sighting(const SE3& T_camera_world, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p_camera = T_camera_world * p_world;
  return {camera().project(p_camera), 1.0 / p_camera.z(), 1.0};
}

}  // namespace tsg::synthetic
