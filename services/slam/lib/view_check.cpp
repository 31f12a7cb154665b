#include "services/slam/lib/view_check.hpp"

#include <algorithm>
#include <array>

#include "services/slam/lib/surface_agreement.hpp"

namespace tsg {
namespace {

constexpr int kColumns = 4;
constexpr int kRows = 4;
constexpr double kMinAgreeingShare = 0.07;  // of the image: what is smaller fits by chance

bool fits(const SurfaceAgreement& agreement, double max_contradiction) {
  return agreement.agreeing >= kMinAgreeingShare * agreement.cells &&
         agreement.contradiction() <= max_contradiction;
}

}  // namespace

int cells_with_matches(const CameraModel& camera, const FrameMatches& matches) {
  std::array<bool, static_cast<std::size_t>(kColumns) * kRows> hit{};
  const std::vector<bool> taken = matches.taken();
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (!taken[i]) continue;
    const Eigen::Vector2f& pixel = matches.features().items[i].pixel;
    const int column = static_cast<int>(pixel.x()) * kColumns / camera.width;
    const int row = static_cast<int>(pixel.y()) * kRows / camera.height;
    const int cell = std::clamp(row, 0, kRows - 1) * kColumns + std::clamp(column, 0, kColumns - 1);
    hit[static_cast<std::size_t>(cell)] = true;
  }
  return static_cast<int>(std::count(hit.begin(), hit.end(), true));
}

bool do_surfaces_fit(const ObservationModel& model,
                     const Features& a,
                     const Features& b,
                     const SE3& T_b_a,
                     double max_contradiction) {
  const double sigma = model.inverse_depth_sigma();
  return fits(compare_surfaces(model.camera(), a.surface, b.surface, T_b_a, sigma),
              max_contradiction) &&
         fits(compare_surfaces(model.camera(), b.surface, a.surface, T_b_a.inverse(), sigma),
              max_contradiction);
}

}  // namespace tsg
