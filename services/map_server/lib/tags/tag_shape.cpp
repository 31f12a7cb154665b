#include "services/map_server/lib/tags/tag_shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tsg {
namespace {

/// Voxels seen in fewer keyframes than this share of what the best are seen in, are noise ...
constexpr double kMinSeenShare = 0.1;
/// ... but however long one looks, so many are enough: the far end of a table may be seen rarely.
constexpr double kEnoughKeyframes = 3.0;
/// Left out at each end of each axis.
constexpr double kTrim = 0.005;
constexpr std::size_t kMaxPositions = 1500;  // of a cloud, to measure it
constexpr float kNoiseReach = 2.0F;          // standard deviations of depth
constexpr float kMaxReach_m = 0.2F;          // at the rim of a wide image noise is guessed too high
constexpr int kShifts = 2;
constexpr int kYawSteps = 18;  // of 5 degrees, within a quarter turn
constexpr float kYawStep_rad = static_cast<float>(M_PI_2) / kYawSteps;
/// A box along the axes of the map is taken where it is larger by no more.
constexpr float kAxisBonus = 1.05F;
constexpr std::size_t kGroundPositions = 400;  // enough for the direction
constexpr std::size_t kRoughPositions = 500;

/// Depth noise smears a surface along the rays, by decimetres at 5 m. Moves `cell`'s position along
/// its ray to where the cloud is densest nearby: there the surface is.
Eigen::Vector3f on_surface(const TagCell& cell, const TagCells& cells) {
  const float noise_m = cell.depth_noise.norm();
  const auto step_m = static_cast<float>(cells.voxel_m());
  const int steps = static_cast<int>(std::min(kNoiseReach * noise_m, kMaxReach_m) / step_m);
  if (steps == 0) return cell.position;
  const Eigen::Vector3f ray = cell.depth_noise / noise_m;
  Eigen::Vector3f position = cell.position;
  for (int round = 0; round < kShifts; ++round) {
    float weights = 0.0F;
    float shift_m = 0.0F;
    for (int i = -steps; i <= steps; ++i) {
      const TagCell* near = cells.at(position + static_cast<float>(i) * step_m * ray);
      if (near == nullptr) continue;
      weights += static_cast<float>(near->keyframes);
      shift_m += static_cast<float>(near->keyframes) * ray.dot(near->position - position);
    }
    if (weights > 0.0F) position += shift_m / weights * ray;
  }
  return position;
}

/// Positions of the voxels that count, at most some kMaxPositions, on the surface.
std::vector<Eigen::Vector3f> surface_positions(const TagCells& cells) {
  std::vector<std::uint32_t> seen;
  seen.reserve(cells.size());
  for (const TagCell& cell : cells.cells()) seen.push_back(cell.keyframes);
  const auto best = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() * 9 / 10);
  if (best != seen.end()) std::nth_element(seen.begin(), best, seen.end());
  const double needed =
      best == seen.end() ? 1.0 : std::min(kEnoughKeyframes, kMinSeenShare * double(*best));
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(cells.size());
  const std::size_t stride = 1 + cells.size() / kMaxPositions;
  for (std::size_t i = 0; i < cells.size(); i += stride) {
    const TagCell& cell = cells.cells()[i];
    if (cell.keyframes >= needed) positions.push_back(on_surface(cell, cells));
  }
  return positions;
}

struct Span {
  float low = 0.0F;
  float high = 0.0F;
  [[nodiscard]] float size() const { return high - low; }
  [[nodiscard]] float middle() const { return 0.5F * (low + high); }
};

/// Between the outermost values, kTrim left out at each end. `values` is not empty; is reordered.
Span trimmed(std::vector<float>& values) {
  const auto skip = static_cast<std::ptrdiff_t>(kTrim * double(values.size()));
  std::nth_element(values.begin(), values.begin() + skip, values.end());
  const float low = values[static_cast<std::size_t>(skip)];
  std::nth_element(values.begin(), values.end() - 1 - skip, values.end());
  return {low, *(values.end() - 1 - skip)};
}

Span span_along(const std::vector<Eigen::Vector3f>& positions, const Eigen::Vector3f& axis) {
  std::vector<float> values;
  values.reserve(positions.size());
  for (const Eigen::Vector3f& position : positions) values.push_back(axis.dot(position));
  return trimmed(values);
}

Eigen::Vector3f along(float yaw_rad) { return {std::cos(yaw_rad), std::sin(yaw_rad), 0.0F}; }
Eigen::Vector3f across(float yaw_rad) { return {-std::sin(yaw_rad), std::cos(yaw_rad), 0.0F}; }

float ground_area(const std::vector<Eigen::Vector3f>& positions, float yaw_rad) {
  return span_along(positions, along(yaw_rad)).size() *
         span_along(positions, across(yaw_rad)).size();
}

/// Direction of a side of the rectangle of least area, 0..pi/2.
float best_yaw(const std::vector<Eigen::Vector3f>& positions) {
  std::vector<Eigen::Vector3f> few;
  const std::size_t stride = 1 + positions.size() / kGroundPositions;
  for (std::size_t i = 0; i < positions.size(); i += stride) few.push_back(positions[i]);
  float best_rad = 0.0F;
  float best_area = ground_area(few, 0.0F) / kAxisBonus;
  const auto consider = [&](float yaw_rad) {
    const float area = ground_area(few, yaw_rad);
    if (area >= best_area) return;
    best_area = area;
    best_rad = yaw_rad;
  };
  for (int step = 1; step < kYawSteps; ++step) consider(kYawStep_rad * static_cast<float>(step));
  const float coarse_rad = best_rad;
  if (coarse_rad == 0.0F) return 0.0F;
  for (const float fine : {-0.6F, -0.4F, -0.2F, 0.2F, 0.4F, 0.6F}) {
    consider(coarse_rad + fine * kYawStep_rad);
  }
  return best_rad;
}

Eigen::AlignedBox3f axis_aligned(const std::vector<Eigen::Vector3f>& positions) {
  Eigen::AlignedBox3f box;
  if (positions.empty()) return box;
  for (int axis = 0; axis < 3; ++axis) {
    const Span span = span_along(positions, Eigen::Vector3f::Unit(axis));
    box.min()[axis] = span.low;
    box.max()[axis] = span.high;
  }
  return box;
}

UprightBox upright(const std::vector<Eigen::Vector3f>& positions) {
  float yaw_rad = best_yaw(positions);
  Span x = span_along(positions, along(yaw_rad));
  Span y = span_along(positions, across(yaw_rad));
  const Span z = span_along(positions, Eigen::Vector3f::UnitZ());
  UprightBox box;
  box.centre = x.middle() * along(yaw_rad) + y.middle() * across(yaw_rad) +
               z.middle() * Eigen::Vector3f::UnitZ();
  if (y.size() > x.size()) {
    std::swap(x, y);
    yaw_rad += yaw_rad > 0.0F ? -static_cast<float>(M_PI_2) : static_cast<float>(M_PI_2);
  }
  box.size = {x.size(), y.size(), z.size()};
  box.yaw_rad = yaw_rad;
  return box;
}

}  // namespace

TagShape measure_shape(const TagCells& cells) {
  const std::vector<Eigen::Vector3f> positions = surface_positions(cells);
  return {axis_aligned(positions), upright(positions)};
}

Eigen::AlignedBox3f rough_box(const TagCells& cells) {
  std::vector<Eigen::Vector3f> positions;
  const std::size_t stride = 1 + cells.size() / kRoughPositions;
  for (std::size_t i = 0; i < cells.size(); i += stride) {
    positions.push_back(cells.cells()[i].position);
  }
  return axis_aligned(positions);
}

}  // namespace tsg
