#include "services/slam/lib/dynamic/depth_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace tsg {
namespace {

constexpr float kConnectedStep = 0.04F;  // relative depth step within one surface
constexpr std::uint8_t kMarked = 255;

std::uint16_t nearest_of(const std::uint16_t* upper, const std::uint16_t* lower, int x) {
  const int left = x * kCellSide + 1;
  std::uint16_t nearest = 0;
  for (const std::uint16_t raw : {upper[left], upper[left + 1], lower[left], lower[left + 1]}) {
    if (raw > 0 && (nearest == 0 || raw < nearest)) nearest = raw;
  }
  return nearest;
}

/// Marks the neighbours of `from` that belong to the same surface and adds them to `next`.
void spread(const cv::Mat& depth,
            const GrowLimits& limits,
            const cv::Point& from,
            cv::Mat& marked,
            std::vector<cv::Point>& next) {
  const cv::Rect inside(0, 0, depth.cols, depth.rows);
  const float here = depth.at<float>(from);
  for (const cv::Point& side :
       {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
    const cv::Point to = from + side;
    if (!inside.contains(to) || marked.at<std::uint8_t>(to) != 0) continue;
    const float there = depth.at<float>(to);
    if (there <= 0.0F || there < limits.nearest || there > limits.farthest) continue;
    if (here > 0.0F && std::abs(there - here) > kConnectedStep * here) continue;
    marked.at<std::uint8_t>(to) = kMarked;
    next.push_back(to);
  }
}

}  // namespace

cv::Point cell_at(const Eigen::Vector2d& pixel) {
  return {static_cast<int>(std::floor((pixel.x() + 0.5) / kCellSide)),
          static_cast<int>(std::floor((pixel.y() + 0.5) / kCellSide))};
}

CameraModel camera_of_cells(const CameraModel& camera) {
  CameraModel small = camera;
  small.width = camera.width / kCellSide;
  small.height = camera.height / kCellSide;
  // Pixel centres are at integers, so the image's corner is at (-0.5, -0.5).
  small.fx = camera.fx / kCellSide;
  small.fy = camera.fy / kCellSide;
  small.cx = (camera.cx + 0.5) / kCellSide - 0.5;
  small.cy = (camera.cy + 0.5) / kCellSide - 0.5;
  return small;
}

cv::Mat depth_of_cells(const RgbdFrame& frame) {
  cv::Mat cells(frame.depth.rows / kCellSide, frame.depth.cols / kCellSide, CV_32FC1);
  const auto metres_per_unit = static_cast<float>(1.0 / frame.depth_units_per_metre);
  for (int y = 0; y < cells.rows; ++y) {
    const auto* upper = frame.depth.ptr<std::uint16_t>(y * kCellSide + 1);
    const auto* lower = frame.depth.ptr<std::uint16_t>(y * kCellSide + 2);
    auto* row = cells.ptr<float>(y);
    for (int x = 0; x < cells.cols; ++x) {
      row[x] = static_cast<float>(nearest_of(upper, lower, x)) * metres_per_unit;
    }
  }
  return cells;
}

cv::Mat pixels_of_cells(const cv::Mat& cells, const cv::Size& size) {
  cv::Mat pixels(size, CV_8UC1);
  const int covered = std::min(size.width, cells.cols * kCellSide);
  for (int y = 0; y < size.height; ++y) {
    auto* row = pixels.ptr<std::uint8_t>(y);
    if (y % kCellSide != 0 || y / kCellSide >= cells.rows) {
      std::copy_n(pixels.ptr<std::uint8_t>(y - 1), size.width, row);
      continue;
    }
    const auto* cell = cells.ptr<std::uint8_t>(y / kCellSide);
    for (int x = 0; x < covered; ++x) row[x] = cell[x / kCellSide];
    std::fill(row + covered, row + size.width, cell[cells.cols - 1]);
  }
  return pixels;
}

void grow_over_surface(const cv::Mat& depth, const GrowLimits& limits, cv::Mat& marked) {
  std::vector<cv::Point> front;
  for (int y = 0; y < marked.rows; ++y) {
    const auto* row = marked.ptr<std::uint8_t>(y);
    for (int x = 0; x < marked.cols; ++x) {
      if (row[x] != 0) front.emplace_back(x, y);
    }
  }
  std::vector<cv::Point> next;
  for (int step = 0; step < limits.steps && !front.empty(); ++step) {
    next.clear();
    for (const cv::Point& from : front) spread(depth, limits, from, marked, next);
    std::swap(front, next);
  }
}

}  // namespace tsg
