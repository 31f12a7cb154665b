#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/render/mesh.hpp"
#include "common/simulation/scene.hpp"

namespace tsg::simulation {

/// A rectangle that gives light: a lamp panel or a window.
struct Lamp {
  Eigen::Vector3f centre_m;
  Eigen::Vector3f half_side_a_m;
  Eigen::Vector3f half_side_b_m;
  Eigen::Vector3f normal;        ///< where it shines
  Eigen::Vector3f radiance_bgr;  ///< linear light; 1 x 1 m of 1.0 gives about 1.0 at 1 m
};

/// A door leaf, window pane or the shell of all rooms: fixed parts of the building.
struct Building {
  render::Mesh shell;       ///< floors, walls with holes, ceilings, skirting, frames, panes, leaves
  std::vector<Lamp> lamps;  ///< ceiling panels and windows
};

/// Builds all rooms of a scene with its doors and windows; world axes.
[[nodiscard]] Building make_building(const SceneDescription& scene);

/// Names of floor and wall surfaces that a scene may use, sorted.
[[nodiscard]] std::vector<std::string> surface_names();

}  // namespace tsg::simulation
