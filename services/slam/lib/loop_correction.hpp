#pragma once

#include <functional>
#include <vector>

#include "services/slam/lib/map.hpp"
#include "services/slam/lib/pose_graph.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// What a closed loop says of two keyframes.
struct LoopEdge {
  KeyframeId a = 0;
  KeyframeId b = 0;
  SE3 T_a_b;
};

/// The essential graph: all keyframes of a part of the map in the order of their ids, the one that
/// began it fixed; each joined with the one before, with those that share many points with it, and
/// by `loops` (those of other parts are passed over).
[[nodiscard]] PoseGraph build_essential_graph(const Map& map,
                                              const std::vector<LoopEdge>& loops,
                                              MapPart part);

/// Relaxes the essential graph of a part and moves that part accordingly. False, and the map as it
/// was, where that failed or was stopped.
[[nodiscard]] bool correct_map(Map& map,
                               const ObservationModel& model,
                               const std::vector<LoopEdge>& loops,
                               MapPart part,
                               const std::function<bool()>& must_stop);

/// Makes one of what two sides of a loop saw twice: looks for the points around `before` in the
/// keyframes around `newest`. Their covisibility joins by that.
void join_sides(Map& map,
                const ObservationModel& model,
                const MapperConfig& config,
                KeyframeId before,
                KeyframeId newest);

}  // namespace tsg
