#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>

#include "services/map_server/lib/keyframe_view.hpp"
#include "services/map_server/lib/semantic_octree.hpp"
#include "services/map_server/lib/tags/tag_cells.hpp"

namespace tsg {

/// Of a position in the map frame, metres.
using PlaceOf = std::function<Place(const Eigen::Vector3f&)>;

struct PlaceShares {
  double free = 0.0;
  double occupied = 0.0;
};

/// What is known of the places of a tag's voxels, from a bounded number of them.
[[nodiscard]] PlaceShares places_of(const TagCells& cells, const PlaceOf& place_of);

/// The part of space that a keyframe looked at.
class ViewVolume {
 public:
  ViewVolume(const KeyframeView& view, const Eigen::Isometry3f& T_world_camera);

  /// Whether a position (map frame) lies within.
  [[nodiscard]] bool holds(const Eigen::Vector3f& position) const;

 private:
  Eigen::Isometry3f T_camera_world_;
  Eigen::AlignedBox2f tangents_;  // x/z and y/z of what the keyframe measured
  float farthest_m_ = 0.0F;
};

}  // namespace tsg
