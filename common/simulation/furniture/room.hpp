#pragma once

#include <string>
#include <vector>

#include "common/render/lamp.hpp"
#include "common/render/mesh.hpp"
#include "common/simulation/scene.hpp"

namespace tsg::simulation {

using render::Lamp;

/// What of a scene is built in and never moves.
struct Building {
  render::Mesh shell;       ///< floors, walls with holes, ceilings, skirting, frames, panes, leaves
  std::vector<Lamp> lamps;  ///< ceiling panels and windows
};

/// Builds all rooms of a scene with its doors and windows; world axes.
[[nodiscard]] Building make_building(const SceneDescription& scene);

/// Names of floor and wall surfaces that a scene may use, sorted.
[[nodiscard]] std::vector<std::string> surface_names();

}  // namespace tsg::simulation
