#pragma once

#include <vector>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/room.hpp"

namespace tsg::simulation {

/// The ceiling of a room and its lamps, evenly spread: panels between acoustic tiles, or round
/// lamps under plaster where the walls are papered.
void add_ceiling(Building& building,
                 Assembly& parts,
                 const RoomDescription& room,
                 std::uint64_t seed);

}  // namespace tsg::simulation
