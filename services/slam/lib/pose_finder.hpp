#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "services/slam/lib/frame_search.hpp"
#include "services/slam/lib/tracking_stage.hpp"

namespace tsg {

/// A pose with the matches that it rests on.
struct Fix {
  SE3 T_camera_world;
  FrameMatches matches;
  int inliers = 0;
  Matrix6d covariance = Matrix6d::Zero();  ///< as in PoseEstimate
  PosePrior prior = {};  ///< by the shape of the scene; without weight where that was not asked
  std::vector<PointId> in_view = {};  ///< points of the map that are in view from there
  /// The pose by this view alone, before the motion held it, and the covariance of that one.
  SE3 T_view_world = {};
  Matrix6d view_covariance = Matrix6d::Zero();
};

/// What there is to find a frame's pose by. Views: valid during the call.
struct PoseQuery {
  const Features& features;
  const LocalMapSnapshot& map;
  const TrackedFrame* last;  ///< tracked before, its pose in `map`; null: never yet in this map
  SE3 T_predicted_world;     ///< camera from world, by the motion until then
  PosePrior motion = {};     ///< the same, with how far it can be trusted; no weight where lost
  bool is_lost = false;      ///< not tracked since `last`, or never: only the map can tell
};

/// Finds the pose of a frame by the last frame, by the shape of the scene, or by keyframes.
/// Deterministic; not thread-safe: Tracker owns it. `config`, `model` and `on_stage` (may be empty)
/// must outlive it.
class PoseFinder {
 public:
  PoseFinder(const SlamConfig& config,
             const ObservationModel& model,
             const std::function<void(TrackingStage)>& on_stage)
      : config_(config), model_(model), on_stage_(on_stage) {}

  /// A first pose by what the last frame saw; nothing where the camera was lost.
  [[nodiscard]] std::optional<Fix> find_first(const PoseQuery& query, MatchedClasses classes) const;

  /// Each way in turn, the cheap ones first; the first pose that the map confirms. `first` is what
  /// find_first() gave for the same features.
  [[nodiscard]] std::optional<Fix> find(const PoseQuery& query, std::optional<Fix> first);

 private:
  [[nodiscard]] std::optional<Fix> by_surface(const PoseQuery& query) const;
  [[nodiscard]] std::optional<Fix> by_keyframes(const PoseQuery& query);
  [[nodiscard]] std::optional<Fix> by_keyframe(const PoseQuery& query,
                                               const SnapshotKeyframe& keyframe) const;
  [[nodiscard]] std::vector<const SnapshotKeyframe*> choose_keyframes(const PoseQuery& query);
  [[nodiscard]] bool is_same_place(const PoseQuery& query,
                                   const SnapshotKeyframe& keyframe,
                                   const Fix& fix) const;
  [[nodiscard]] bool refine(const PoseQuery& query, Fix& fix) const;
  [[nodiscard]] PoseEstimate by_what_stays(Fix& fix) const;
  void hold_by_motion(const PoseQuery& query,
                      const FrameMatches& all,
                      PoseEstimate& estimate,
                      Fix& fix) const;
  [[nodiscard]] bool is_weak(const Fix& fix) const;
  [[nodiscard]] bool is_certain(const Fix& fix) const;
  void begin(TrackingStage stage) const {
    if (on_stage_) on_stage_(stage);
  }

  const SlamConfig& config_;
  const ObservationModel& model_;
  const std::function<void(TrackingStage)>& on_stage_;
  std::size_t next_attempt_ = 0;  ///< keyframe that is tried next where none is recalled
};

}  // namespace tsg
