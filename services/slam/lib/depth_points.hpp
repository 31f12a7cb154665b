#pragma once

#include <vector>

#include "services/slam/lib/map.hpp"

namespace tsg {

/// Makes a new map point of each feature of `keyframe` that has a depth and shows none yet. Returns
/// their ids.
std::vector<PointId> add_points_from_depth(Map& map,
                                           const ObservationModel& model,
                                           Keyframe& keyframe);

}  // namespace tsg
