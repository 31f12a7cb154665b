#pragma once

#include <octomap/ColorOcTree.h>

#include <Eigen/Core>

#include "common/render/mesh.hpp"

namespace tsg {

/// The surface of a map as seen from `eye_m` (axes of the map): the sides of occupied leaves that
/// face the eye and border on space that was seen to be free. So a room opens like a doll's house:
/// the near walls and the ceiling, of which only the inside was seen, are not there.
[[nodiscard]] render::Mesh make_map_mesh(const octomap::ColorOcTree& tree,
                                         const Eigen::Vector3d& eye_m);

/// How much of that surface the eye sees, not counting what hides what: m^2 across the line of
/// sight. For choosing an eye.
[[nodiscard]] double visible_area_m2(const octomap::ColorOcTree& tree,
                                     const Eigen::Vector3d& eye_m);

/// A box around the occupied leaves, without the few that lie far out.
struct MapExtent {
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_m = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d centre_m() const { return 0.5 * (low_m + high_m); }
};

/// Of a tree with at least one occupied leaf.
[[nodiscard]] MapExtent extent_of(const octomap::ColorOcTree& tree);

}  // namespace tsg
