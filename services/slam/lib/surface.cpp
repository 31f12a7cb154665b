#include "services/slam/lib/surface.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "services/slam/lib/features.hpp"

namespace tsg {
namespace {

constexpr int kFitRadius = 2;           // cells: planes are fitted to 5x5 of them
constexpr int kMinFitted = 13;          // of 25: more than half
constexpr double kMaxFitSigmas = 4.0;   // further from the centre's inverse depth: another surface
constexpr double kStepPerCell = 0.015;  // share of inverse depth that slopes change by, per cell
constexpr double kMinCellCosine = 0.1;  // flatter: the depth of a cell is not one number

/// Undistorted (x/z, y/z) of the centres of all cells.
std::vector<Eigen::Vector2d> make_rays(const CameraModel& camera, const Surface& surface) {
  std::vector<cv::Point2d> pixels;
  for (int row = 0; row < surface.rows; ++row) {
    for (int column = 0; column < surface.columns; ++column) {
      pixels.emplace_back(column * kSurfaceCell, row * kSurfaceCell);
    }
  }
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::undistortPoints(pixels, pixels, K, camera.distortion);
  std::vector<Eigen::Vector2d> rays;
  rays.reserve(pixels.size());
  for (const cv::Point2d& pixel : pixels) rays.emplace_back(pixel.x, pixel.y);
  return rays;
}

/// Fits the plane around a cell. Inverse depth is linear in the image of a plane: with n p = d and
/// p = (x, y, 1) / rho, rho = (n / d) (x, y, 1).
std::optional<SurfacePatch> fit_patch(const Surface& surface,
                                      const std::vector<Eigen::Vector2d>& rays,
                                      int column,
                                      int row,
                                      double sigma) {
  const double centre = surface.at(column, row);
  if (centre <= 0.0) return std::nullopt;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  int fitted = 0;
  for (int y = row - kFitRadius; y <= row + kFitRadius; ++y) {
    for (int x = column - kFitRadius; x <= column + kFitRadius; ++x) {
      const double value = surface.at(x, y);
      const double step = std::max(std::abs(x - column), std::abs(y - row)) * kStepPerCell * centre;
      if (value <= 0.0 || std::abs(value - centre) > kMaxFitSigmas * sigma + step) continue;
      const Eigen::Vector3d ray = rays[surface.index(x, y)].homogeneous();
      H += ray * ray.transpose();
      b += ray * value;
      ++fitted;
    }
  }
  if (fitted < kMinFitted) return std::nullopt;
  const Eigen::Vector3d plane = H.ldlt().solve(b);
  const Eigen::Vector3d ray = rays[surface.index(column, row)].homogeneous();
  const double inverse_depth = plane.dot(ray);
  if (!(inverse_depth > 0.0) || std::abs(inverse_depth - centre) > kMaxFitSigmas * sigma) {
    return std::nullopt;
  }
  const Eigen::Vector3d normal = -plane.normalized();
  if (-normal.dot(ray.normalized()) < kMinCellCosine) return std::nullopt;
  return SurfacePatch{ray / inverse_depth, normal};
}

}  // namespace

Surface sample_surface(const RgbdFrame& frame,
                       const cv::Mat& verdicts,
                       const FeatureConfig& config) {
  Surface surface{.columns = (frame.depth.cols - 1) / kSurfaceCell + 1,
                  .rows = (frame.depth.rows - 1) / kSurfaceCell + 1,
                  .inverse_depths = {}};
  surface.inverse_depths.reserve(surface.index(0, surface.rows));
  const double nearest = config.min_depth_m * frame.depth_units_per_metre;
  const double farthest = config.max_depth_m * frame.depth_units_per_metre;
  for (int y = 0; y < frame.depth.rows; y += kSurfaceCell) {
    const auto* row = frame.depth.ptr<std::uint16_t>(y);
    for (int x = 0; x < frame.depth.cols; x += kSurfaceCell) {
      const bool dynamic =
          !verdicts.empty() &&
          static_cast<FeatureVerdict>(verdicts.at<std::uint8_t>(y, x)) == FeatureVerdict::kDynamic;
      const bool usable = !dynamic && row[x] >= nearest && row[x] <= farthest;
      surface.inverse_depths.push_back(
          usable ? static_cast<float>(frame.depth_units_per_metre / row[x]) : 0.0F);
    }
  }
  return surface;
}

PatchGrid::PatchGrid(const CameraModel& camera, const Surface& surface, const FeatureConfig& config)
    : columns_(surface.columns),
      rows_(surface.rows),
      patch_of_cell_(surface.inverse_depths.size(), -1) {
  const std::vector<Eigen::Vector2d> rays = make_rays(camera, surface);
  for (int row = kFitRadius; row + kFitRadius < rows_; ++row) {
    for (int column = kFitRadius; column + kFitRadius < columns_; ++column) {
      const auto patch = fit_patch(surface, rays, column, row, config.inverse_depth_sigma);
      if (!patch) continue;
      patch_of_cell_[surface.index(column, row)] = static_cast<int>(patches_.size());
      patches_.push_back(*patch);
    }
  }
}

const SurfacePatch* PatchGrid::find(const Eigen::Vector2d& pixel,
                                    int columns_beside,
                                    int rows_beside) const {
  const int column = static_cast<int>(std::lround(pixel.x() / kSurfaceCell)) + columns_beside;
  const int row = static_cast<int>(std::lround(pixel.y() / kSurfaceCell)) + rows_beside;
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return nullptr;
  const int cell = row * columns_ + column;
  const int patch = patch_of_cell_[static_cast<std::size_t>(cell)];
  return patch < 0 ? nullptr : &patches_[static_cast<std::size_t>(patch)];
}

}  // namespace tsg
