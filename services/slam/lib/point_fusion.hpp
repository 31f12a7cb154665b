#pragma once

#include "services/slam/lib/map.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Looks for `points` in a keyframe, within `radius` pixels of a feature's level: a feature found
/// becomes one more observation, and where it shows another point, the two become one. Appearances
/// are left as they were.
void fuse_points_into(Map& map,
                      const ObservationModel& model,
                      const std::vector<PointId>& points,
                      KeyframeId keyframe,
                      double radius);

/// Looks for the points of `newest` in its neighbours and the other way round.
void fuse_with_neighbours(Map& map,
                          const ObservationModel& model,
                          const MapperConfig& config,
                          KeyframeId newest);

}  // namespace tsg
