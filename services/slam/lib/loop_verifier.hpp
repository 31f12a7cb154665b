#pragma once

#include <optional>

#include "services/slam/lib/frame_matches.hpp"
#include "services/slam/lib/map.hpp"
#include "services/slam/lib/observation_model.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// A view that the part of the map around a keyframe explains.
struct VerifiedView {
  KeyframeId candidate = 0;
  SE3 T_world_camera;  ///< of the view, by that part of the map
  int inliers = 0;
};

/// Decides by geometry whether a keyframe shows the place of another. Prefers to say no: a wrong
/// loop ruins a map, a missed one comes again a keyframe later. A yes needs many matches that agree
/// on one pose, spread over the image, and depth images that do not contradict it: where the same
/// chair stands in another room, one would see through the walls of the first.
/// Holds references only: lives as long as the call.
class LoopVerifier {
 public:
  LoopVerifier(const ObservationModel& model, const LoopConfig& config, const Map& map)
      : model_(model), config_(config), map_(map) {}

  /// Where `seen` is if it shows what `candidate` does, by nothing but what the two look like.
  [[nodiscard]] std::optional<VerifiedView> verify(const Keyframe& seen,
                                                   KeyframeId candidate) const;

  /// The same where the pose is known roughly: better than 20 cm and a few degrees.
  [[nodiscard]] std::optional<VerifiedView> verify_near(const Keyframe& seen,
                                                        KeyframeId candidate,
                                                        const SE3& T_world_camera) const;

 private:
  [[nodiscard]] FrameMatches match_by_looks(const Keyframe& seen, const Keyframe& candidate) const;
  void match_neighbourhood(const Keyframe& candidate,
                           const SE3& T_world_camera,
                           double radius_px,
                           FrameMatches& matches) const;
  [[nodiscard]] std::optional<VerifiedView> judge(const Keyframe& seen,
                                                  const Keyframe& candidate,
                                                  const SE3& T_world_camera,
                                                  const FrameMatches& matches) const;

  const ObservationModel& model_;
  const LoopConfig& config_;
  const Map& map_;
};

}  // namespace tsg
