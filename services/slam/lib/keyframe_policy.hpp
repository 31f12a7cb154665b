#pragma once

#include "common/geometry/se3.hpp"
#include "services/slam/lib/local_map_snapshot.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// How much a frame's view differs from that of a keyframe: translation over the scene's depth plus
/// rotation in radians; i.e. about by how many focal lengths points move in the image.
[[nodiscard]] double view_change(const SE3& T_keyframe_camera, double scene_depth_m);

/// What speaks for and against making a frame a keyframe.
struct KeyframeEvidence {
  double nearest_view_change = 0.0;  ///< to the keyframe with the most similar view
  int map_inliers = 0;               ///< features of the frame that show a map point
  int reference_points = 0;          ///< map points that the reference keyframe shows
};

/// Compares a tracked frame with the keyframes of `map`. `reference` is the one of them that shares
/// most points with it.
[[nodiscard]] KeyframeEvidence weigh_view(const LocalMapSnapshot& map,
                                          const SnapshotKeyframe& reference,
                                          const Features& features,
                                          const SE3& T_world_camera,
                                          int map_inliers);

/// True where the frame sees something new. Never while the camera stands where a keyframe is: then
/// what is new is noise, or moves.
[[nodiscard]] bool is_worth_a_keyframe(const KeyframeEvidence& evidence,
                                       const TrackerConfig& config);

}  // namespace tsg
