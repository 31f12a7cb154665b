#pragma once

#include <memory>
#include <vector>

#include "services/slam/lib/frame_matches.hpp"
#include "services/slam/lib/local_map_snapshot.hpp"
#include "services/slam/lib/observation_model.hpp"

namespace tsg {

/// A frame whose pose is known.
struct TrackedFrame {
  std::shared_ptr<const Features> features;
  std::vector<PointId> points;      ///< per feature, or kNoPoint
  std::vector<bool> doubtful = {};  ///< per feature: not seen to stand still; empty: none is
  KeyframeId reference = 0;
  SE3 T_reference_camera = {};
  SE3 T_world_camera;
};

/// Which points of the frame before are searched.
enum class LastFramePoints {
  kMapped,  ///< those in the map
  /// Those and all with a depth that were seen to stand still. What may be a part of something that
  /// moves would take the camera along from frame to frame.
  kSeenToStay,
  kWithDepth,  ///< all that have a depth, which carries the pose on where there is no map yet
};

/// Which features of the two frames may be matched.
enum class MatchedClasses {
  kStatic,  ///< only on things that never move: those that may move wait until they were judged
  kAll,
};

/// Finds points in the features of one frame. Holds references only: lives as long as the call.
class FrameSearch {
 public:
  FrameSearch(const ObservationModel& model,
              const LocalMapSnapshot& map,
              const Features& features,
              MatchedClasses classes = MatchedClasses::kAll)
      : model_(model), map_(map), features_(features), classes_(classes) {}

  /// The points of `last`, within `radius_px` of where `T_camera_world` shows them.
  [[nodiscard]] FrameMatches match_last_frame(const TrackedFrame& last,
                                              LastFramePoints which,
                                              const SE3& T_camera_world,
                                              double radius_px) const;

  /// The map points of a keyframe, by looks alone.
  [[nodiscard]] FrameMatches match_keyframe(const SnapshotKeyframe& keyframe) const;

  /// Adds the points of the map that are in view from `T_camera_world` and not matched yet. Returns
  /// the ids of all points that are in view.
  std::vector<PointId> match_local_map(const SE3& T_camera_world,
                                       double radius_px,
                                       FrameMatches& matches) const;

 private:
  const ObservationModel& model_;
  const LocalMapSnapshot& map_;
  const Features& features_;
  MatchedClasses classes_;
};

}  // namespace tsg
