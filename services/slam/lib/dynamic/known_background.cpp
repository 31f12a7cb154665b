#include "services/slam/lib/dynamic/known_background.hpp"

#include <opencv2/imgproc.hpp>

#include "services/slam/lib/dynamic/seen_through.hpp"

namespace tsg {
namespace {

/// Of inverse depth, 1/m: a fourth of the sensor's. Who stands before a wall must not pass for it,
/// and where noise hides the wall, features are left out that could be kept.
constexpr double kSurfaceSigma = 0.0008;

}  // namespace

void KnownBackground::note(const cv::Mat& depth, const cv::Mat& things, const SE3& T_world_camera) {
  cv::Mat around;
  cv::dilate(things, around, cv::Mat());
  depth_ = depth.clone();
  depth_.setTo(0.0, around);
  T_world_camera_ = T_world_camera;
}

cv::Mat KnownBackground::find(const CameraModel& camera,
                              const cv::Mat& depth,
                              const SE3& T_world_camera) const {
  cv::Mat evidence = cv::Mat::zeros(depth.size(), CV_8UC1);
  if (depth_.empty()) return evidence;
  compare_depth(camera, {depth, T_world_camera}, {depth_, T_world_camera_}, kSurfaceSigma,
                evidence);
  return evidence == static_cast<double>(CellEvidence::kSame);
}

}  // namespace tsg
