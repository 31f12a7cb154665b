#pragma once

#include "services/slam/lib/loop_detector.hpp"
#include "services/slam/lib/map.hpp"

namespace tsg {

/// Moves one part of the map into the world of another, `into`, whose keyframes stay where they
/// are. `T_into_from` takes points from the one world to the other.
void merge_part(
    Map& map, const ObservationModel& model, MapPart from, MapPart into, const SE3& T_into_from);

/// Where the two keyframes of `loop` belong to different parts, makes one part of both: the main
/// part takes in the other; where neither is the main part, the older one the newer.
void merge_parts_of(Map& map, const ObservationModel& model, const Loop& loop, MapPart main_part);

}  // namespace tsg
