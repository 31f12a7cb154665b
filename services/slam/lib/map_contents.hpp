#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "common/geometry/camera_model.hpp"
#include "services/slam/lib/loop_correction.hpp"
#include "services/slam/lib/map.hpp"

namespace tsg {

/// A keyframe that was taken out, relative to one that was not then.
struct CulledKeyframe {
  KeyframeId parent = 0;
  SE3 T_parent_camera;
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;
};

/// All that LocalMapper knows, as values: what a map file holds. A mapper made of it goes on as the
/// one it was taken from. Every id that is mentioned is there.
struct MapContents {
  CameraModel camera;
  std::vector<Keyframe> keyframes;  ///< sorted by id, never empty
  std::vector<MapPoint> points;     ///< sorted by id
  std::map<KeyframeId, CulledKeyframe> culled;
  std::vector<LoopEdge> loops;
  std::vector<PointId> recent_points;  ///< on trial still
  KeyframeId newest = 0;
  PointId next_point = 0;     ///< id that the next one gets
  bool is_adjusting = false;  ///< a full adjustment was due or under way
};

}  // namespace tsg
