#include "services/slam/lib/keyframe_policy.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace tsg {
namespace {

constexpr int kEstablished = 2;        // observations of a point that is no mere candidate
constexpr double kDefaultDepth = 2.0;  // metres, of a scene without any depth

double median_depth(const Features& features) {
  std::vector<float> inverse_depths;
  for (const Feature& feature : features.items) {
    if (feature.has_depth()) inverse_depths.push_back(feature.inverse_depth);
  }
  if (inverse_depths.empty()) return kDefaultDepth;
  const auto middle =
      inverse_depths.begin() + static_cast<std::ptrdiff_t>(inverse_depths.size() / 2);
  std::nth_element(inverse_depths.begin(), middle, inverse_depths.end());
  return 1.0 / *middle;
}

}  // namespace

double view_change(const SE3& T_keyframe_camera, double scene_depth_m) {
  return T_keyframe_camera.translation().norm() / scene_depth_m + T_keyframe_camera.angle();
}

KeyframeEvidence weigh_view(const LocalMapSnapshot& map,
                            const SnapshotKeyframe& reference,
                            const Features& features,
                            const SE3& T_world_camera,
                            int map_inliers) {
  const double depth = median_depth(features);
  KeyframeEvidence evidence{.nearest_view_change = std::numeric_limits<double>::max(),
                            .map_inliers = map_inliers};
  for (const SnapshotKeyframe& keyframe : map.keyframes) {
    const SE3 T_keyframe_camera = keyframe.T_world_camera.inverse() * T_world_camera;
    evidence.nearest_view_change =
        std::min(evidence.nearest_view_change, view_change(T_keyframe_camera, depth));
  }
  const int established = map.keyframes.size() > kEstablished ? kEstablished : 1;
  for (const PointId id : reference.points) {
    const SnapshotPoint* point = id == kNoPoint ? nullptr : map.find_point(id);
    if (point != nullptr && point->observations >= established) ++evidence.reference_points;
  }
  return evidence;
}

bool is_worth_a_keyframe(const KeyframeEvidence& evidence, const TrackerConfig& config) {
  if (evidence.nearest_view_change < config.standing_still) return false;
  if (evidence.nearest_view_change > config.keyframe_view_change) return true;
  return evidence.map_inliers < config.keyframe_overlap * evidence.reference_points;
}

}  // namespace tsg
