#pragma once

#include <optional>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/pose_optimizer.hpp"
#include "services/slam/lib/surface.hpp"

namespace tsg {

/// SurfaceAlignment::agreement that right alignments of a real sensor reach.
inline constexpr double kGoodAgreement = 0.96;

/// How one surface lies to another.
struct SurfaceAlignment {
  SE3 T_camera_reference;
  /// Of a left-hand twist of T_camera_reference; has no weight where the surfaces may slide.
  Matrix6d information = Matrix6d::Zero();
  double overlap =
      0.0;  ///< share of the camera's patches that lie where the reference saw something
  double agreement = 0.0;  ///< share of these that fit the reference's plane
};

/// Moves the patches of `camera` onto the planes of `reference` (point-to-plane ICP with projective
/// association; Chen and Medioni 1992), from `T_camera_reference` on. Nothing where they do not
/// overlap enough. Directions that the surfaces do not determine stay as they were.
[[nodiscard]] std::optional<SurfaceAlignment> align_surfaces(const ObservationModel& model,
                                                             const PatchGrid& reference,
                                                             const PatchGrid& camera,
                                                             const SE3& T_camera_reference);

}  // namespace tsg
