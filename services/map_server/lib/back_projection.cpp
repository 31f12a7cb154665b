#include "services/map_server/lib/back_projection.hpp"

#include <cmath>
#include <cstddef>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <utility>

namespace tsg {
namespace {

/// Rays into the open are cast from every this many pixels in x and y: 4 cm apart at 5 m.
constexpr int kFreeEndStride = 4;

cv::Mat1d matrix_of(const CameraModel& camera) {
  return (cv::Mat1d(3, 3) << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0);
}

/// The class of each value of the label image.
std::array<ClassId, kMaxInstances + 1> classes_of_labels(const MapKeyframe& keyframe,
                                                         ClassTable& classes) {
  std::array<ClassId, kMaxInstances + 1> ids{};
  ids[0] = keyframe.has_labels ? kBackgroundClass : kNotSegmentedClass;
  const auto& instances = keyframe.instances.instances;
  for (std::size_t i = 0; i < instances.size(); ++i)
    ids[i + 1] = classes.id_of(instances[i].class_name);
  return ids;
}

}  // namespace

BackProjector::BackProjector(DepthFilterConfig depth, ExclusionConfig exclusion)
    : depth_(depth), exclusion_(std::move(exclusion)) {}

KeyframeCloud BackProjector::project(const MapKeyframe& keyframe, ClassTable& classes) {
  const RgbdFrame& frame = keyframe.frame;
  prepare_rays(frame.camera);
  cv::Mat1b excluded = excluded_pixels(keyframe, exclusion_);
  excluded.setTo(255, without_ray_);
  cv::Mat1b usable = usable_depth(frame.depth, frame.depth_units_per_metre, depth_);
  usable.setTo(0, excluded);
  const auto class_of_label = classes_of_labels(keyframe, classes);
  const auto metres_per_unit = static_cast<float>(1.0 / frame.depth_units_per_metre);

  KeyframeCloud cloud;
  const auto count = static_cast<std::size_t>(cv::countNonZero(usable));
  cloud.points.reserve(count);
  cloud.label_of_point.reserve(count);
  for (int v = 0; v < usable.rows; ++v) {
    const auto* depth = frame.depth.ptr<std::uint16_t>(v);
    const auto* colour = frame.colour.ptr<cv::Vec3b>(v);
    const auto* labels = keyframe.has_labels ? keyframe.instances.labels.ptr(v) : nullptr;
    for (int u = 0; u < usable.cols; ++u) {
      if (usable(v, u) == 0) continue;
      const std::uint8_t label = labels != nullptr ? labels[u] : std::uint8_t{0};
      const cv::Vec3b& bgr = colour[u];
      cloud.points.push_back({point_at(u, v, metres_per_unit * static_cast<float>(depth[u])),
                              {bgr[2], bgr[1], bgr[0]},
                              class_of_label[label],
                              1});
      cloud.label_of_point.push_back(label);
    }
  }
  cloud.free_ends = free_ends(frame, excluded);
  return cloud;
}

void BackProjector::prepare_rays(const CameraModel& camera) {
  if (camera == camera_) return;
  std::vector<cv::Point2d> pixels;
  pixels.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) pixels.emplace_back(u, v);
  }
  const cv::Mat1d distortion(1, 5, const_cast<double*>(camera.distortion.data()));  // NOLINT
  std::vector<cv::Point2d> normalised;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-7);
  cv::undistortPoints(pixels, normalised, matrix_of(camera), distortion, cv::noArray(),
                      cv::noArray(), until);
  rays_.clear();
  rays_.reserve(normalised.size());
  without_ray_ = cv::Mat1b(camera.height, camera.width, std::uint8_t{0});
  for (std::size_t i = 0; i < normalised.size(); ++i) {
    const cv::Point2d& ray = normalised[i];
    rays_.emplace_back(static_cast<float>(ray.x), static_cast<float>(ray.y));
    const bool is_usable = std::abs(ray.x) <= kMaxTangent && std::abs(ray.y) <= kMaxTangent;
    if (!is_usable) *(without_ray_.begin() + static_cast<std::ptrdiff_t>(i)) = 255;  // or NaN
  }
  camera_ = camera;
}

Eigen::Vector3f BackProjector::point_at(int u, int v, float depth_m) const {
  const auto index = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width) +
                     static_cast<std::size_t>(u);
  return {depth_m * rays_[index].x(), depth_m * rays_[index].y(), depth_m};
}

std::vector<Eigen::Vector3f> BackProjector::free_ends(const RgbdFrame& frame,
                                                      const cv::Mat1b& excluded) const {
  std::vector<Eigen::Vector3f> ends;
  const double max_raw = depth_.max_depth_m * frame.depth_units_per_metre;
  for (int v = 0; v < excluded.rows; v += kFreeEndStride) {
    const auto* depth = frame.depth.ptr<std::uint16_t>(v);
    for (int u = 0; u < excluded.cols; u += kFreeEndStride) {
      if (excluded(v, u) != 0 || depth[u] <= max_raw) continue;
      ends.push_back(point_at(u, v, static_cast<float>(depth_.max_depth_m)));
    }
  }
  return ends;
}

}  // namespace tsg
