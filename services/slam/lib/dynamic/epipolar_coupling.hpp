#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "services/slam/lib/dynamic/method.hpp"
#include "services/slam/lib/features.hpp"

namespace tsg {

struct CouplingConfig {
  double threshold_px = 1.0;  // in level 0, whatever the feature's level; as in the paper (4.3)
  double search_radius_px = 30.0;  // a camera turning by 1.5 rad/s, or two frames at half of it
};

/// What two frames say about the motion of each feature of the later one.
struct CouplingVerdicts {
  /// Nothing where too few matches, or ones without parallax, leave it open (TwoViews::F).
  std::optional<Eigen::Matrix3d> fundamental;
  std::vector<float> epipolar_px;  ///< distance from the epipolar line; negative: not tested
  std::vector<bool> is_dynamic;
  int matches = 0;  ///< between the two frames, whatever their prior
};

/// The coupling of instance segmentation and epipolar geometry (paper 4.2, 4.3). Features are
/// matched frame to frame, whatever they lie on. kTsg estimates the fundamental matrix from those
/// matches alone whose features have the prior kStatic in both frames, kEpipolar (to compare with)
/// from all of them; other methods are not for here. Then every match is tested, whatever its
/// prior:
/// * further than threshold_px from its epipolar line, it is dynamic, else not. So an instance of a
///   class that could move is kept while it does not. What moves along its epipolar line is not
///   seen to move.
/// * Without parallax no line can be told from another (TwoViews): then what does not move is seen
///   where the homography of the static matches puts it, and what is further than threshold_px
///   (times 1.25, for noise in two directions) from there is dynamic.
/// * What could not be tested, because it has no match or because there are too few of them for a
///   geometry, is dynamic with kTsg if its prior is not kStatic: only reliable static features are
///   kept. kEpipolar, which knows no classes, keeps it.
/// Deterministic.
[[nodiscard]] CouplingVerdicts judge_by_epipolar_lines(const Features& reference,
                                                       const Features& current,
                                                       DynamicMethod method,
                                                       const CouplingConfig& config);

}  // namespace tsg
