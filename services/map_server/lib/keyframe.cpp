#include "services/map_server/lib/keyframe.hpp"

#include <cmath>
#include <opencv2/core.hpp>
#include <sstream>
#include <string>

namespace tsg {
namespace {

Expected<void> check_pose(const MapKeyframe& keyframe, double max_extent_m) {
  if (!keyframe.T_world_camera.is_finite()) {
    return make_error(ExitCode::kInvalidNumber,
                      "its pose is not finite; the sender must not publish such a keyframe");
  }
  const Eigen::Vector3d t_world_camera = keyframe.T_world_camera.translation();
  if (t_world_camera.cwiseAbs().maxCoeff() > max_extent_m) {
    std::ostringstream text;
    text << "its position (" << t_world_camera.transpose() << ") m is farther than " << max_extent_m
         << " m from the origin; raise map_server.max_extent_m if it is true";
    return make_error(ExitCode::kBadData, text.str());
  }
  return {};
}

Expected<void> check_image(const cv::Mat& image,
                           const CameraModel& camera,
                           int type,
                           const char* name) {
  if (image.cols == camera.width && image.rows == camera.height && image.type() == type) return {};
  std::ostringstream text;
  text << "its " << name << " image is " << image.cols << "x" << image.rows << " of OpenCV type "
       << image.type() << ", but " << camera.width << "x" << camera.height << " of type " << type
       << " is needed; colour, depth and labels must have the camera's size";
  return make_error(ExitCode::kSizeMismatch, text.str());
}

Expected<void> check_depth(const RgbdFrame& frame) {
  if (!std::isfinite(frame.depth_units_per_metre) || frame.depth_units_per_metre <= 0.0) {
    return make_error(ExitCode::kInvalidNumber,
                      "its depth_units_per_metre is not a positive number; set the depth scale of "
                      "the camera");
  }
  if (cv::countNonZero(frame.depth) > 0) return {};
  return make_error(ExitCode::kBadData,
                    "it holds no depth at all; check that the depth camera works and is "
                    "registered to the colour camera");
}

Expected<void> check_labels(const MapKeyframe& keyframe) {
  if (!keyframe.has_labels) return {};
  const InstanceSegmentation& instances = keyframe.instances;
  auto size = check_image(instances.labels, keyframe.frame.camera, CV_8UC1, "label");
  if (!size) return size;
  double largest = 0.0;
  cv::minMaxIdx(instances.labels, nullptr, &largest);
  if (static_cast<std::size_t>(largest) <= instances.instances.size()) return {};
  return make_error(ExitCode::kBadData,
                    "its label image names instance " + std::to_string(static_cast<int>(largest)) +
                        " of " + std::to_string(instances.instances.size()) +
                        "; labels must be 0 or the number of an instance of the same keyframe");
}

}  // namespace

Expected<void> check_keyframe(const MapKeyframe& keyframe, double max_extent_m) {
  const RgbdFrame& frame = keyframe.frame;
  return check_pose(keyframe, max_extent_m)
      .and_then([&]() -> Expected<void> {
        const auto problems = frame.camera.problems();
        if (problems.empty()) return {};
        return make_error(ExitCode::kBadData, "its camera is unusable: " + problems.front());
      })
      .and_then([&] { return check_image(frame.colour, frame.camera, CV_8UC3, "colour"); })
      .and_then([&] { return check_image(frame.depth, frame.camera, CV_16UC1, "depth"); })
      .and_then([&] { return check_labels(keyframe); })
      .and_then([&] { return check_depth(frame); });
}

}  // namespace tsg
