#pragma once

#include <Eigen/Core>
#include <optional>

#include "services/slam/lib/feature_matcher.hpp"
#include "services/slam/lib/map.hpp"
#include "services/slam/lib/observation_model.hpp"

namespace tsg {

/// Where from and how widely points are searched in an image.
struct ProjectionSearch {
  SE3 T_camera_world;
  double radius = 4.0;             ///< pixels in the level where the point is expected
  double depth_gate_sigmas = 8.0;  ///< of inverse depth
};

/// What is known of how a point looks.
struct PointAppearance {
  Eigen::Vector3d position;  ///< world
  Eigen::Vector3d normal;    ///< world, mean direction to the cameras that saw it
  double min_distance = 0.0;
  double max_distance = 0.0;
  const Descriptor* descriptor = nullptr;
};

[[nodiscard]] PointAppearance appearance_of(const MapPoint& point);

/// The target to search for; nothing where the point is outside of the image, or nearer, farther
/// or more from the side than its descriptor allows for.
[[nodiscard]] std::optional<MatchTarget> project_point(const ObservationModel& model,
                                                       const ProjectionSearch& search,
                                                       const PointAppearance& point);

}  // namespace tsg
