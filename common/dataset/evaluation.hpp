#pragma once

#include <cstdint>
#include <vector>

#include "common/core/error.hpp"
#include "common/core/statistics.hpp"
#include "common/dataset/association.hpp"
#include "common/dataset/trajectory.hpp"

namespace tsg {

/// Two trajectories brought together: pairs of poses of one moment.
struct MatchedPose {
  std::int64_t stamp_ns = 0;  ///< of the estimate
  SE3 T_world_truth;
  SE3 T_estimate_camera;  ///< in the estimate's own frame
};

/// Absolute trajectory error (paper eq. 10).
struct AbsoluteError {
  Summary translation_m;
  SE3 T_world_estimate;              ///< the rigid alignment, least squares over positions
  std::vector<MatchedPose> matched;  ///< as associated, not aligned
  std::vector<double> errors_m;      ///< of matched[i] after alignment
};

enum class DeltaUnit { kFrames, kSeconds };

/// Over which distance relative errors are taken.
struct RelativeErrorConfig {
  double delta = 1.0;  ///< frames (a whole number) or seconds
  DeltaUnit unit = DeltaUnit::kSeconds;
  std::int64_t max_difference_ns = kDefaultMaxDifferenceNs;
};

/// Relative pose error (paper eq. 11).
struct RelativeError {
  Summary translation_m;
  Summary rotation_deg;
};

/// Pairs estimate and truth (associate()); kEmptyInput for fewer than three pairs, which fix no
/// alignment.
[[nodiscard]] Expected<std::vector<MatchedPose>> match_poses(
    const Trajectory& truth,
    const Trajectory& estimate,
    std::int64_t max_difference_ns = kDefaultMaxDifferenceNs);

/// ATE after rigid alignment (Umeyama without scale).
[[nodiscard]] Expected<AbsoluteError> absolute_error(
    const Trajectory& truth,
    const Trajectory& estimate,
    std::int64_t max_difference_ns = kDefaultMaxDifferenceNs);

/// RPE over pairs of matched poses `delta` frames apart, or the pose closest to `delta` seconds
/// later, if there is one within max_difference_ns of that. kUsage for an unusable delta,
/// kEmptyInput where no two poses lie that far apart.
[[nodiscard]] Expected<RelativeError> relative_error(const Trajectory& truth,
                                                     const Trajectory& estimate,
                                                     const RelativeErrorConfig& config);

/// By how much an error shrank against a reference, as a fraction (paper eq. 12; 1 = gone,
/// negative = worse). `reference_error` must be positive.
[[nodiscard]] double improvement_rate(double reference_error, double error);

}  // namespace tsg
