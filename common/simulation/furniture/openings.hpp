#pragma once

#include <optional>
#include <vector>

#include "common/simulation/furniture/room.hpp"
#include "common/simulation/furniture/wall.hpp"
#include "common/simulation/random.hpp"

namespace tsg::simulation {

/// Frames, leaves and thresholds of all doors. A leaf opens into the first room that the door is
/// cut into; a door that leads nowhere stays shut.
void add_doors(Assembly& parts, const SceneDescription& scene, const std::vector<Wall>& walls);

/// A leaf in its own axes: hinges along z at the origin, closed along +y, its face at x = 0.
[[nodiscard]] render::Mesh make_leaf(float width_m, float height_m, Random& random);

/// Frames and sills of all windows and, where they lead out of the building, what is seen through
/// them and their light.
void add_windows(Building& building,
                 Assembly& parts,
                 const std::vector<Wall>& walls,
                 std::uint64_t seed);

}  // namespace tsg::simulation
