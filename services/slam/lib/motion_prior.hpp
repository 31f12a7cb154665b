#pragma once

#include "services/slam/lib/pose_optimizer.hpp"

namespace tsg {

/// What a camera can do between two frames: a pose of which the view leaves much open is held by
/// how the camera moved until then. `covariance` is that of the last pose (a left-hand twist of
/// T_camera_world), from which `T_camera_world` was predicted over `seconds`.
[[nodiscard]] PosePrior prior_by_motion(const SE3& T_camera_world,
                                        const Matrix6d& covariance,
                                        double seconds);

/// Whether a pose that was found without the prior may be one that the motion led to. Where not,
/// the camera was jerked, and the prior is wrong.
[[nodiscard]] bool agrees_with_motion(const PosePrior& prior, const PoseEstimate& estimate);

}  // namespace tsg
