#pragma once

#include <map>

#include "services/slam/lib/map.hpp"

namespace tsg {

/// New poses of keyframes: T_world_camera by id.
using KeyframeTargets = std::map<KeyframeId, SE3>;

/// Moves keyframes to where they belong and map points along with the keyframe that made them.
/// Keyframes without a target move along with the last one before them, in their part of the map,
/// that has one. At least one must have one. Brings the appearance of all points in line.
void move_map(Map& map, const ObservationModel& model, const KeyframeTargets& targets);

}  // namespace tsg
