#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/simulation/people/skinning.hpp"

namespace tsg::simulation {

/// A cross-section of a part of the body: an oval whose front and back may differ.
struct Ring {
  Eigen::Vector3f centre_m;
  float half_width_m;  ///< along `TubeStyle::side`
  float front_m;       ///< along `TubeStyle::depth`
  float back_m;        ///< against it
  Skin skin;
  float squareness = 2.0F;  ///< exponent of the oval: 2 an ellipse, 4 nearly a rounded box
};

/// How a tube is spun. depth x side = the direction from the first ring to the last.
struct TubeStyle {
  Eigen::Vector3f depth = Eigen::Vector3f::UnitX();
  Eigen::Vector3f side = Eigen::Vector3f::UnitY();
  int sides = 20;
  std::uint32_t material = 0;
  float texture_height_m = 1.0F;  ///< of the tube's length from its last ring; u: once around,
                                  ///< 0.5 in front
  bool is_capped = true;          ///< both ends, rounded
};

/// Adds a tube through `rings`; returns the number of its first point. Points go ring by ring, each
/// of sides + 1, the first and last of which are in the same place (at the back).
std::size_t add_tube(SkinnedMesh& mesh, const std::vector<Ring>& rings, const TubeStyle& style);

/// Computes normals of all points from the faces around them; points in the same place that were
/// made by one add_tube() share theirs.
void finish_normals(SkinnedMesh& mesh);

/// More rings between those given, on a smooth curve (Catmull-Rom) through them.
[[nodiscard]] std::vector<Ring> refined(const std::vector<Ring>& rings, int times);

}  // namespace tsg::simulation
