#include "services/slam/lib/pnp.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace tsg {
namespace {

constexpr int kPnpIterations = 300;
constexpr float kMaxReprojectionError = 6.0F;  // pixels; optimisation judges more strictly
constexpr double kConfidence = 0.995;
constexpr std::size_t kMinPnpMatches = 6;

SE3 from_opencv(const cv::Vec3d& rotation_vector, const cv::Vec3d& translation) {
  const Eigen::Vector3d axis(rotation_vector[0], rotation_vector[1], rotation_vector[2]);
  const double angle = axis.norm();
  const Eigen::Quaterniond rotation =
      angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis / angle))
                  : Eigen::Quaterniond::Identity();
  return {rotation, Eigen::Vector3d(translation[0], translation[1], translation[2])};
}

/// OpenCV's RANSAC starts its generator anew in each call: the same matches give the same pose.
std::optional<SE3> ransac(const CameraModel& camera, const std::vector<PointMatch>& matches) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const PointMatch& match : matches) {
    points.emplace_back(match.p_world.x(), match.p_world.y(), match.p_world.z());
    pixels.emplace_back(match.observation.pixel.x(), match.observation.pixel.y());
  }
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::Vec3d rotation_vector;
  cv::Vec3d translation;
  try {
    const bool found = cv::solvePnPRansac(points, pixels, K, cv::noArray(), rotation_vector,
                                          translation, false, kPnpIterations, kMaxReprojectionError,
                                          kConfidence, cv::noArray(), cv::SOLVEPNP_AP3P);
    if (!found) return std::nullopt;
  } catch (const cv::Exception&) {
    return std::nullopt;  // degenerate samples only: there is no pose to be had from them
  }
  const SE3 T_camera_world = from_opencv(rotation_vector, translation);
  if (!T_camera_world.is_finite()) return std::nullopt;
  return T_camera_world;
}

}  // namespace

std::optional<PoseEstimate> solve_pnp(const ObservationModel& model,
                                      const std::vector<PointMatch>& matches,
                                      int min_inliers) {
  if (matches.size() < kMinPnpMatches) return std::nullopt;
  const std::optional<SE3> T_camera_world = ransac(model.camera(), matches);
  if (!T_camera_world) return std::nullopt;
  PoseEstimate estimate = optimise_pose(model, matches, *T_camera_world);
  if (estimate.inliers < min_inliers) return std::nullopt;
  return estimate;
}

}  // namespace tsg
