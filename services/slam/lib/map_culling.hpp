#pragma once

#include <optional>
#include <vector>

#include "services/slam/lib/map.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Removes from `recent` (and the map) points that proved bad, i.e. that tracking rarely finds or
/// that no second keyframe saw by the time two more had come; those that passed the test leave
/// `recent` as well.
void cull_recent_points(Map& map, KeyframeId newest, std::vector<PointId>& recent);

/// A keyframe around `newest` that others make redundant: at least config.redundant_share of its
/// points are seen, as large or larger, by three others. Never the first of a part nor the newest.
[[nodiscard]] std::optional<KeyframeId> find_redundant_keyframe(const Map& map,
                                                                const MapperConfig& config,
                                                                KeyframeId newest);

}  // namespace tsg
