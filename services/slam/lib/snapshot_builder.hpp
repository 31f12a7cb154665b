#pragma once

#include "services/slam/lib/local_map_snapshot.hpp"
#include "services/slam/lib/map.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Copies what tracking needs around keyframe `newest`: it, its covisible neighbours, then the
/// keyframes that look at the same place from near by, whether linked or not. So a place that is
/// seen again is matched to what was mapped there first.
[[nodiscard]] LocalMapSnapshot build_snapshot(const Map& map,
                                              const MapperConfig& config,
                                              KeyframeId newest);

/// Copies what finding a lost camera needs: `recalled`, the keyframes that may show its view, all
/// of one part of the map and at least one, and their covisible neighbours.
[[nodiscard]] LocalMapSnapshot build_recall_snapshot(const Map& map,
                                                     const MapperConfig& config,
                                                     KeyframeId newest,
                                                     const std::vector<KeyframeId>& recalled);

}  // namespace tsg
