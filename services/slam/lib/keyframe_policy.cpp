#include "services/slam/lib/keyframe_policy.hpp"

namespace tsg {

double view_change(const SE3& T_keyframe_camera, double scene_depth_m) {
  return T_keyframe_camera.translation().norm() / scene_depth_m + T_keyframe_camera.angle();
}

bool is_worth_a_keyframe(const KeyframeEvidence& evidence, const TrackerConfig& config) {
  if (evidence.nearest_view_change < config.standing_still) return false;
  if (evidence.nearest_view_change > config.keyframe_view_change) return true;
  return evidence.map_inliers < config.keyframe_overlap * evidence.reference_points;
}

}  // namespace tsg
