#include "services/slam/lib/surface_agreement.hpp"

#include <algorithm>
#include <cmath>

#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr int kStride = 2;          // cells: every fourth is enough to judge by
constexpr double kTolerance = 7.0;  // standard deviations: two measurements and the poses

enum class CellVerdict { kNothing, kAgrees, kSeenThrough, kHidden };

/// Compares an inverse depth with what the surface has around a pixel.
CellVerdict judge(const Surface& surface,
                  const Eigen::Vector2d& pixel,
                  double inverse_depth,
                  double tolerance) {
  const int column = static_cast<int>(std::lround(pixel.x() / kSurfaceCell));
  const int row = static_cast<int>(std::lround(pixel.y() / kSurfaceCell));
  if (column < 1 || row < 1 || column + 1 >= surface.columns || row + 1 >= surface.rows) {
    return CellVerdict::kNothing;
  }
  double nearest = 0.0;
  for (int y = row - 1; y <= row + 1; ++y) {
    for (int x = column - 1; x <= column + 1; ++x) {
      const double seen = surface.at(x, y);
      // A hole may be anything: then the place is not judged, unless a neighbour agrees.
      if (seen <= 0.0) continue;
      if (std::abs(seen - inverse_depth) <= tolerance) return CellVerdict::kAgrees;
      nearest = std::max(nearest, seen);
    }
  }
  if (surface.at(column, row) <= 0.0) return CellVerdict::kNothing;
  return nearest < inverse_depth ? CellVerdict::kSeenThrough : CellVerdict::kHidden;
}

void note(CellVerdict judgement, SurfaceAgreement& agreement) {
  if (judgement == CellVerdict::kAgrees) ++agreement.agreeing;
  if (judgement == CellVerdict::kSeenThrough) ++agreement.seen_through;
  if (judgement == CellVerdict::kHidden) ++agreement.hidden;
}

}  // namespace

SurfaceAgreement compare_surfaces(const CameraModel& camera,
                                  const Surface& seen_by_a,
                                  const Surface& seen_by_b,
                                  const SE3& T_b_a,
                                  double sigma) {
  SurfaceAgreement agreement;
  for (int row = 0; row < seen_by_a.rows; row += kStride) {
    for (int column = 0; column < seen_by_a.columns; column += kStride) {
      ++agreement.cells;
      const double inverse_depth = seen_by_a.at(column, row);
      if (inverse_depth <= 0.0) continue;
      // Lens distortion moves a point by less than the cells that it is compared with.
      const Eigen::Vector2d pixel(column * kSurfaceCell, row * kSurfaceCell);
      const Eigen::Vector3d p_b = T_b_a * camera.unproject(pixel, 1.0 / inverse_depth);
      if (p_b.z() < kMinDepth) continue;
      note(judge(seen_by_b, camera.project(p_b), 1.0 / p_b.z(), kTolerance * sigma), agreement);
    }
  }
  return agreement;
}

}  // namespace tsg
