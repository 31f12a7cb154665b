#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/slam/lib/features.hpp"

namespace tsg {

/// A point that is expected in an image: where, at which scale, and what it looks like.
struct MatchTarget {
  int source = 0;  ///< the caller's index of the point
  Eigen::Vector2f pixel;
  float radius = 0.0F;           ///< pixels around `pixel` that are searched
  float inverse_depth = 0.0F;    ///< expected
  float max_depth_error = 0.0F;  ///< 1/m; features whose own depth differs by more do not match
  int min_level = 0;
  int max_level = 0;
  float angle = 0.0F;  ///< radians; only used by keep_consistent_rotations()
  const Descriptor* descriptor = nullptr;
};

/// A feature that shows a target.
struct FeatureMatch {
  int source = 0;   ///< MatchTarget::source
  int feature = 0;  ///< index in Features
  int distance = 0;
  float rotation = 0.0F;  ///< radians the feature is turned against the target
};

struct MatchLimits {
  int max_distance = 100;  ///< of descriptors, of 256
  float max_ratio = 1.0F;  ///< of the best to the second best distance in the same level
};

/// For each target the feature that looks most like it; a feature serves its best target only.
/// Features with `taken[i]` (may be empty) are passed over. Sorted by feature.
[[nodiscard]] std::vector<FeatureMatch> match_by_projection(const Features& features,
                                                            const std::vector<MatchTarget>& targets,
                                                            const std::vector<bool>& taken,
                                                            const MatchLimits& limits);

/// Compares the features of `from` with `usable[i]` to all of `to`, wherever they are: for when
/// nothing is known of the pose. FeatureMatch::source is the index in `from`.
[[nodiscard]] std::vector<FeatureMatch> match_by_descriptor(const Features& from,
                                                            const std::vector<bool>& usable,
                                                            const Features& to,
                                                            const MatchLimits& limits);

/// Drops matches that turn otherwise than most do: one camera rolls by one angle.
void keep_consistent_rotations(std::vector<FeatureMatch>& matches);

}  // namespace tsg
