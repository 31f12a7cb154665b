#pragma once

#include <optional>

#include "services/slam/lib/frame_search.hpp"
#include "services/slam/lib/pose_optimizer.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// What the shape of the scene alone says about the pose of the frame with `features`: its depth
/// laid onto that of `last`, from the predicted pose on and from the last one. Nothing where the
/// surfaces do not fit well. Takes tens of milliseconds: for when corners fail.
[[nodiscard]] std::optional<PosePrior> pose_by_surface(const ObservationModel& model,
                                                       const FeatureConfig& config,
                                                       const TrackedFrame& last,
                                                       const Features& features,
                                                       const SE3& T_camera_world);

}  // namespace tsg
