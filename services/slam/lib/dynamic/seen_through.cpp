#include "services/slam/lib/dynamic/seen_through.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr double kSigmas = 4.0;          // of the difference of two measurements
constexpr double kPoseError = 0.02;      // metres: along the ray, of pose and calibration together
constexpr double kRelativeError = 0.01;  // of depth: the sensor's bias, and slopes within a cell

/// Inverse depth may be off by this much, 1/m.
float tolerance(double sigma, float inverse_depth) {
  const double noise = kSigmas * std::sqrt(2.0) * sigma;
  return static_cast<float>(noise + kPoseError * inverse_depth * inverse_depth +
                            kRelativeError * inverse_depth);
}

/// Whether all around a cell was seen and lay behind `inverse_depth`: at silhouettes a pose that is
/// off by a little would show one surface through the other, and of thin things the sensor misses
/// parts at random.
bool lay_behind(const cv::Mat& depth, const cv::Point& cell, float inverse_depth, float allowed) {
  for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
    const auto* line = depth.ptr<float>(y);
    for (int x = cell.x - 1; x <= cell.x + 1; ++x) {
      if (line[x] <= 0.0F || inverse_depth - 1.0F / line[x] <= allowed) return false;
    }
  }
  return true;
}

CellEvidence judge(const cv::Mat& then, float depth, const cv::Point& cell, double sigma) {
  const float seen = then.at<float>(cell);
  if (seen <= 0.0F) return CellEvidence::kNone;
  const float inverse_depth = 1.0F / depth;
  const float allowed = tolerance(sigma, inverse_depth);
  const float nearer_by = inverse_depth - 1.0F / seen;
  if (nearer_by < -allowed) return CellEvidence::kNone;
  if (nearer_by <= allowed) return CellEvidence::kSame;
  return lay_behind(then, cell, inverse_depth, allowed) ? CellEvidence::kAppeared
                                                        : CellEvidence::kNone;
}

/// Lays cells of one camera into the view of another, in single precision: it is done for all.
class Overlay {
 public:
  Overlay(const CameraModel& camera, const SE3& T_then_now)
      : R_(T_then_now.rotation_matrix().cast<float>()),
        t_(T_then_now.translation().cast<float>()),
        focal_(static_cast<float>(camera.fx), static_cast<float>(camera.fy)),
        centre_(static_cast<float>(camera.cx), static_cast<float>(camera.cy)) {}

  [[nodiscard]] Eigen::Vector3f point(int column, int row, float depth) const {
    const Eigen::Vector3f ray((static_cast<float>(column) - centre_.x()) / focal_.x(),
                              (static_cast<float>(row) - centre_.y()) / focal_.y(), 1.0F);
    return R_ * (depth * ray) + t_;
  }
  [[nodiscard]] cv::Point cell(const Eigen::Vector3f& p_then) const {
    return {cvRound(focal_.x() * p_then.x() / p_then.z() + centre_.x()),
            cvRound(focal_.y() * p_then.y() / p_then.z() + centre_.y())};
  }

 private:
  Eigen::Matrix3f R_;
  Eigen::Vector3f t_;
  Eigen::Vector2f focal_;
  Eigen::Vector2f centre_;
};

}  // namespace

void compare_depth(const CameraModel& camera,
                   const DepthView& now,
                   const DepthView& then,
                   double sigma,
                   cv::Mat& evidence) {
  const Overlay overlay(camera, then.T_world_camera.inverse() * now.T_world_camera);
  const cv::Rect inner(1, 1, then.depth.cols - 2,
                       then.depth.rows - 2);  // all cells around are there
  for (int y = 0; y < now.depth.rows; ++y) {
    const auto* depths = now.depth.ptr<float>(y);
    auto* found = evidence.ptr<std::uint8_t>(y);
    for (int x = 0; x < now.depth.cols; ++x) {
      if (depths[x] < kMinDepth) continue;
      const Eigen::Vector3f p_then = overlay.point(x, y, depths[x]);
      if (p_then.z() < kMinDepth) continue;
      const cv::Point cell = overlay.cell(p_then);
      if (!inner.contains(cell)) continue;
      const CellEvidence says = judge(then.depth, p_then.z(), cell, sigma);
      if (says != CellEvidence::kNone) found[x] = static_cast<std::uint8_t>(says);
    }
  }
}

cv::Mat appeared_regions(const cv::Mat& evidence, int min_cells) {
  const cv::Mat appeared = evidence == static_cast<double>(CellEvidence::kAppeared);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(appeared, labels, stats, centroids, 8, CV_32S);
  cv::Mat kept = cv::Mat::zeros(evidence.size(), CV_8UC1);
  for (int y = 0; y < labels.rows; ++y) {
    const auto* label = labels.ptr<int>(y);
    auto* row = kept.ptr<std::uint8_t>(y);
    for (int x = 0; x < labels.cols; ++x) {
      const bool is_big = label[x] > 0 && stats.at<int>(label[x], cv::CC_STAT_AREA) >= min_cells;
      row[x] = is_big ? 255 : 0;
    }
  }
  CV_Assert(count >= 1);
  return kept;
}

}  // namespace tsg
