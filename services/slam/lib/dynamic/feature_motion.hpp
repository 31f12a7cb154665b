#pragma once

#include <vector>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/observation_model.hpp"

namespace tsg {

/// Whether a feature lies where a thing that stands still would be.
enum class FeatureMotion : std::uint8_t {
  kUnknown,  ///< not found in the earlier frame, or without depth there
  kStill,
  kMoved,
};

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

/// The features that moved together with most of their neighbours at like depth: a wrong match
/// stands alone. Neighbours that could not be tested go along.
[[nodiscard]] std::vector<bool> moving_in_company(const Features& features,
                                                  const std::vector<FeatureMotion>& motion);

}  // namespace tsg
