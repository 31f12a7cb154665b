#include "services/slam/lib/dynamic/seen_through.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

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

/// Where the cells of a row lie in another view.
struct LaidRow {
  std::vector<float> depth;  ///< from there, metres
  std::vector<int> column;   ///< of no meaning where `depth` is not positive
  std::vector<int> row;
};

/// Lays cells of one camera into the view of another, in single precision and row by row: it is
/// done for all, and so several are done at once.
class Overlay {
 public:
  Overlay(const CameraModel& camera, const SE3& T_then_now)
      : R_(T_then_now.rotation_matrix().cast<float>()),
        t_(T_then_now.translation().cast<float>()),
        focal_(static_cast<float>(camera.fx), static_cast<float>(camera.fy)),
        centre_(static_cast<float>(camera.cx), static_cast<float>(camera.cy)) {
    for (int column = 0; column < camera.width; ++column) {
      rays_x_.push_back((static_cast<float>(column) - centre_.x()) / focal_.x());
    }
  }

  void lay(const cv::Mat& depth, int row, LaidRow& laid) const {
    const auto width = rays_x_.size();
    laid.depth.resize(width);
    laid.column.resize(width);
    laid.row.resize(width);
    const auto* depths = depth.ptr<float>(row);
    const float ray_y = (static_cast<float>(row) - centre_.y()) / focal_.y();
    for (std::size_t i = 0; i < width; ++i) {
      const float x = depths[i] * rays_x_[i];
      const float y = depths[i] * ray_y;
      const float z_then = coordinate(2, x, y, depths[i]);
      laid.depth[i] = z_then;
      laid.column[i] = cell(focal_.x() * coordinate(0, x, y, depths[i]) / z_then + centre_.x());
      laid.row[i] = cell(focal_.y() * coordinate(1, x, y, depths[i]) / z_then + centre_.y());
    }
  }

 private:
  [[nodiscard]] float coordinate(int axis, float x, float y, float z) const {
    return R_(axis, 0) * x + (R_(axis, 1) * y + R_(axis, 2) * z) + t_[axis];
  }
  [[nodiscard]] static int cell(float pixel) {
    constexpr float kFar = 1e6F;  // outside, and still a whole number
    return static_cast<int>(std::rint(std::min(std::max(-kFar, pixel), kFar)));
  }

  Eigen::Matrix3f R_;
  Eigen::Vector3f t_;
  Eigen::Vector2f focal_;
  Eigen::Vector2f centre_;
  std::vector<float> rays_x_;  ///< x/z of each column
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
  LaidRow laid;
  for (int y = 0; y < now.depth.rows; ++y) {
    overlay.lay(now.depth, y, laid);
    const auto* depths = now.depth.ptr<float>(y);
    auto* found = evidence.ptr<std::uint8_t>(y);
    for (int x = 0; x < now.depth.cols; ++x) {
      const auto i = static_cast<std::size_t>(x);
      if (depths[x] < kMinDepth || laid.depth[i] < kMinDepth) continue;
      const cv::Point cell(laid.column[i], laid.row[i]);
      if (!inner.contains(cell)) continue;
      const CellEvidence says = judge(then.depth, laid.depth[i], cell, sigma);
      if (says != CellEvidence::kNone) found[x] = static_cast<std::uint8_t>(says);
    }
  }
}

cv::Mat appeared_regions(const cv::Mat& evidence, int min_cells) {
  const cv::Mat appeared = evidence == static_cast<double>(CellEvidence::kAppeared);
  cv::Mat labels;
  const int count = cv::connectedComponents(appeared, labels, 8, CV_32S);
  std::vector<int> areas(static_cast<std::size_t>(count), 0);
  std::for_each(labels.begin<int>(), labels.end<int>(),
                [&areas](int label) { ++areas[static_cast<std::size_t>(label)]; });
  areas.front() = 0;  // what did not appear
  cv::Mat kept = cv::Mat::zeros(evidence.size(), CV_8UC1);
  for (int y = 0; y < labels.rows; ++y) {
    const auto* label = labels.ptr<int>(y);
    auto* row = kept.ptr<std::uint8_t>(y);
    for (int x = 0; x < labels.cols; ++x) {
      row[x] = areas[static_cast<std::size_t>(label[x])] >= min_cells ? 255 : 0;
    }
  }
  return kept;
}

}  // namespace tsg
