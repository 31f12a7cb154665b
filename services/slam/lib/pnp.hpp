#pragma once

#include <optional>
#include <vector>

#include "services/slam/lib/pose_optimizer.hpp"

namespace tsg {

/// The pose that most matches agree on, wrong ones among them (RANSAC over three-point solutions,
/// then optimise_pose()). Nothing where fewer than `min_inliers` agree. Needs no first guess.
[[nodiscard]] std::optional<PoseEstimate> solve_pnp(const ObservationModel& model,
                                                    const std::vector<PointMatch>& matches,
                                                    int min_inliers);

}  // namespace tsg
