#pragma once

#include <optional>
#include <vector>

#include "services/slam/lib/map.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// The point that two cameras see at `a` and `b`, in the axes of camera a. Nothing where the lines
/// of sight are too much alike to tell how far it is, or where it does not fit both sightings.
[[nodiscard]] std::optional<Eigen::Vector3d> triangulate(const ObservationModel& model,
                                                         const PointObservation& a,
                                                         const PointObservation& b,
                                                         const SE3& T_b_a);

/// Makes map points of what the depth sensor does not reach: features of `newest` without depth
/// that look like one of a neighbour and, by the two poses, show one point beyond max_depth_m.
/// Nearer ones have no depth for a reason, most often as two things only seem to meet there.
/// Returns the ids of the new points.
std::vector<PointId> add_points_by_triangulation(Map& map,
                                                 const ObservationModel& model,
                                                 const SlamConfig& config,
                                                 KeyframeId newest);

}  // namespace tsg
