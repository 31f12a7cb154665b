#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/observation_model.hpp"

namespace tsg {

/// Whether a feature lies where a thing that stands still would be.
enum class Motion : std::uint8_t {
  kUnknown,  ///< not found in the earlier frame, or without depth there
  kStill,
  kMoved,
};

struct FeatureMotion {
  Motion motion = Motion::kUnknown;
  /// From where it would be to where it is: pixels, and inverse depth in units that weigh as much.
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();
};

/// Whether two features that moved may have moved together, as parts of one thing.
[[nodiscard]] bool moved_alike(const FeatureMotion& a, const FeatureMotion& b);

/// Features of an earlier frame and where it was taken.
struct FeatureView {
  const Features& features;
  SE3 T_world_camera;
};

/// For each feature of `now`: laid over from `then` by its depth, is it seen where it should be?
/// Unlike the epipolar line, which says nothing of a motion along it, this tests all three
/// dimensions, by the noise of corner and depth.
[[nodiscard]] std::vector<FeatureMotion> compare_features(const ObservationModel& model,
                                                          const FeatureView& now,
                                                          const FeatureView& then);

/// The features that moved alike with most of their neighbours at like depth: wrong matches go
/// their own ways. Neighbours that could not be tested go along.
[[nodiscard]] std::vector<bool> moving_in_company(const Features& features,
                                                  const std::vector<FeatureMotion>& motion);

}  // namespace tsg
