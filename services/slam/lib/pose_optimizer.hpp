#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/observation_model.hpp"

namespace tsg {

/// A map point and where the image shows it.
struct PointMatch {
  Eigen::Vector3d p_world;
  PointObservation observation;
};

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// What is known of a pose without the matches.
struct PosePrior {
  SE3 T_camera_world;
  Matrix6d information = Matrix6d::Zero();  ///< of a left-hand twist of it, translation first
};

struct PoseEstimate {
  SE3 T_camera_world;
  std::vector<bool> is_inlier;  ///< one for each match
  int inliers = 0;
  /// Of a left-hand twist of T_camera_world, translation first; only set with >= 3 inliers.
  Matrix6d covariance = Matrix6d::Zero();
};

/// Minimises the robust (Huber) reprojection error of `matches` over the pose alone, from
/// `T_camera_world` on, in rounds that take outliers out and let them in again.
/// Levenberg-Marquardt with analytic derivatives.
[[nodiscard]] PoseEstimate optimise_pose(const ObservationModel& model,
                                         const std::vector<PointMatch>& matches,
                                         const SE3& T_camera_world,
                                         const PosePrior& prior = {});

}  // namespace tsg
