#pragma once

#include "services/slam/lib/map.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Looks for the points of `newest` in its neighbours and the other way round: a feature found
/// there becomes one more observation, and where it shows another point, the two become one.
void fuse_with_neighbours(Map& map,
                          const ObservationModel& model,
                          const MapperConfig& config,
                          KeyframeId newest);

}  // namespace tsg
