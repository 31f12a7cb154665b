#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/observation_model.hpp"

namespace tsg {

/// Camera poses and points that are adjusted to observations of the one by the other.
struct BundleProblem {
  struct Camera {
    SE3 T_camera_world;
    bool fixed = false;  ///< at least one must be, or nothing holds the whole in place
  };
  struct Sighting {
    std::size_t camera = 0;
    std::size_t point = 0;
    PointObservation observation;
  };
  std::vector<Camera> cameras;
  std::vector<Eigen::Vector3d> points;  ///< world
  std::vector<Sighting> sightings;
};

struct BundleLimits {
  int max_iterations = 10;
  double time_budget_s = 0.0;            ///< 0 = none
  std::function<bool()> must_stop = {};  ///< asked after each iteration; may be empty
};

struct BundleSummary {
  double initial_cost = 0.0;
  double final_cost = 0.0;
  int iterations = 0;
  bool usable = false;  ///< the problem holds an improved or equal solution
};

/// Minimises the robust (Huber) reprojection error over points and free cameras, in place, with
/// Ceres (Schur complement, one thread, analytic derivatives). Also when stopped early, what it has
/// reached by then is a valid state, never worse than before.
BundleSummary adjust_bundle(const ObservationModel& model,
                            const BundleLimits& limits,
                            BundleProblem& problem);

}  // namespace tsg
