#include "services/tsgctl/scene_truth/body_volume.hpp"

#include <algorithm>
#include <cmath>

namespace tsg {
namespace {

constexpr float kSamplesPerEdge = 2.0F;  // of a voxel: no voxel of a 6-connected wall is left out

/// Calls `use(point)` for points of a triangle, none farther than `step_m` from the next.
template <typename Use>
void sample(const std::array<Eigen::Vector3f, 3>& corners, float step_m, const Use& use) {
  const auto& [a, b, c] = corners;
  const float longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
  const int steps = std::max(1, static_cast<int>(std::ceil(longest / step_m)));
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps - i; ++j) {
      const float along_b = static_cast<float>(i) / static_cast<float>(steps);
      const float along_c = static_cast<float>(j) / static_cast<float>(steps);
      use(Eigen::Vector3f(a + along_b * (b - a) + along_c * (c - a)));
    }
  }
}

template <typename Use>
void sample(const Surface& surface, float voxel_m, const Use& use) {
  for (const auto& [a, b, c] : surface.triangles) {
    sample({surface.points[a], surface.points[b], surface.points[c]}, voxel_m / kSamplesPerEdge,
           use);
  }
}

/// The voxels around one body, with a margin of one that is outside it for certain.
class BodyBox {
 public:
  BodyBox(const Surface& surface, float voxel_m) : voxel_m_(voxel_m) {
    Eigen::Vector3f low = surface.points.front();
    Eigen::Vector3f high = low;
    for (const Eigen::Vector3f& point : surface.points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    first_ = cell_of(low) - Eigen::Vector3i::Ones();
    size_ = cell_of(high) - first_ + Eigen::Vector3i::Constant(2);
    cells_.assign(static_cast<std::size_t>(size_.prod()), Cell::kUnknown);
  }

  void mark_surface(const Eigen::Vector3f& point) { at(cell_of(point) - first_) = Cell::kSurface; }

  /// Spreads from a corner, through faces of voxels, as far as the surface lets it.
  void mark_outside() {
    std::vector<Eigen::Vector3i> front{Eigen::Vector3i::Zero()};
    at(front.back()) = Cell::kOutside;
    while (!front.empty()) {
      const Eigen::Vector3i cell = front.back();
      front.pop_back();
      for (int face = 0; face < 6; ++face) {
        const Eigen::Vector3i next =
            cell + (face % 2 == 0 ? 1 : -1) * Eigen::Vector3i::Unit(face / 2);
        if ((next.array() < 0).any() || (next.array() >= size_.array()).any()) continue;
        if (at(next) != Cell::kUnknown) continue;
        at(next) = Cell::kOutside;
        front.push_back(next);
      }
    }
  }

  void add_to(VoxelSet& voxels) const {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i] == Cell::kOutside) continue;
      const int index = static_cast<int>(i);
      const Eigen::Vector3i cell(index % size_.x(), index / size_.x() % size_.y(),
                                 index / size_.x() / size_.y());
      voxels.insert(voxel_m_ * ((cell + first_).cast<float>().array() + 0.5F).matrix());
    }
  }

 private:
  enum class Cell : std::uint8_t { kUnknown, kSurface, kOutside };

  [[nodiscard]] Eigen::Vector3i cell_of(const Eigen::Vector3f& point) const {
    return (point / voxel_m_).array().floor().cast<int>();
  }
  Cell& at(const Eigen::Vector3i& cell) {
    return cells_[static_cast<std::size_t>((cell.z() * size_.y() + cell.y()) * size_.x() +
                                           cell.x())];
  }

  float voxel_m_;
  Eigen::Vector3i first_;
  Eigen::Vector3i size_;
  std::vector<Cell> cells_;
};

}  // namespace

void add_surface(const Surface& surface, VoxelSet& voxels) {
  sample(surface, static_cast<float>(voxels.edge_m()),
         [&](const Eigen::Vector3f& point) { voxels.insert(point); });
}

void add_body(const Surface& surface, VoxelSet& voxels) {
  if (surface.points.empty()) return;
  const auto voxel_m = static_cast<float>(voxels.edge_m());
  BodyBox box(surface, voxel_m);
  sample(surface, voxel_m, [&](const Eigen::Vector3f& point) { box.mark_surface(point); });
  box.mark_outside();
  box.add_to(voxels);
}

}  // namespace tsg
