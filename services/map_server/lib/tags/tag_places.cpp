#include "services/map_server/lib/tags/tag_places.hpp"

#include <algorithm>
#include <cstddef>

namespace tsg {
namespace {

constexpr std::size_t kPlaceSamples = 64;  // voxels of a tag: a share good to 6 %
constexpr std::size_t kViewStride = 8;     // of a keyframe's points: enough for its outline

}  // namespace

PlaceShares places_of(const TagCells& cells, const PlaceOf& place_of) {
  PlaceShares shares;
  if (cells.empty()) return shares;
  const std::size_t stride = 1 + (cells.size() - 1) / kPlaceSamples;
  double looked_at = 0.0;
  for (std::size_t i = 0; i < cells.size(); i += stride) {
    looked_at += 1.0;
    const Place place = place_of(cells.cells()[i].position);
    shares.free += place == Place::kFree ? 1.0 : 0.0;
    shares.occupied += place == Place::kOccupied ? 1.0 : 0.0;
  }
  return {shares.free / looked_at, shares.occupied / looked_at};
}

ViewVolume::ViewVolume(const KeyframeView& view, const Eigen::Isometry3f& T_world_camera)
    : T_camera_world_(T_world_camera.inverse()) {
  const auto take_in = [this](const Eigen::Vector3f& position) {
    tangents_.extend(Eigen::Vector2f(position.head<2>() / position.z()));
    farthest_m_ = std::max(farthest_m_, position.z());
  };
  for (std::size_t i = 0; i < view.points.size(); i += kViewStride)
    take_in(view.points[i].position);
  for (std::size_t i = 0; i < view.free_ends.size(); i += kViewStride) take_in(view.free_ends[i]);
}

bool ViewVolume::holds(const Eigen::Vector3f& position) const {
  const Eigen::Vector3f in_camera = T_camera_world_ * position;
  if (in_camera.z() <= 0.0F || in_camera.z() > farthest_m_) return false;
  return tangents_.contains(Eigen::Vector2f(in_camera.head<2>() / in_camera.z()));
}

}  // namespace tsg
