#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/ids.hpp"

namespace tsg {

/// What tracking needs to know of a map point.
struct SnapshotPoint {
  PointId id = kNoPoint;
  Eigen::Vector3d position;   ///< world
  Eigen::Vector3f normal;     ///< world, unit: mean direction from the cameras that saw it
  float min_distance = 0.0F;  ///< metres from which it is matched: the pyramid's range
  float max_distance = 0.0F;
  int observations = 0;  ///< keyframes that see it
  Descriptor descriptor{};
};

/// What tracking needs to know of a keyframe.
struct SnapshotKeyframe {
  KeyframeId id = 0;
  SE3 T_world_camera;
  std::shared_ptr<const Features> features;
  std::vector<PointId> points;  ///< per feature, or kNoPoint
};

/// The part of the map around the newest keyframe as it was at one moment. Never changes, bounded
/// by MapperConfig, may be kept and read by any thread.
struct LocalMapSnapshot {
  std::uint64_t version = 0;          ///< counts up with every change of the map
  std::uint64_t corrections = 0;      ///< how often all of the map was moved, as a loop was closed
  KeyframeId newest = 0;              ///< keyframe that was inserted last
  MapPart part = 0;                   ///< that all its keyframes belong to
  MapPart main_part = 0;              ///< the one whose world is the frame `map`
  std::vector<SnapshotPoint> points;  ///< sorted by id
  std::vector<SnapshotKeyframe> keyframes;  ///< sorted by id; empty before the first
  std::vector<KeyframeId> recalled;  ///< that may show the view of a lost frame, likeliest first
  std::size_t map_keyframes = 0;     ///< in the whole map
  std::size_t map_points = 0;

  /// Null where the keyframe or point is not part of the snapshot.
  [[nodiscard]] const SnapshotKeyframe* find_keyframe(KeyframeId id) const;
  [[nodiscard]] const SnapshotPoint* find_point(PointId id) const;

  /// The keyframe that sees most of `seen` (may hold kNoPoint), the oldest of several; none where
  /// none sees any.
  [[nodiscard]] std::optional<KeyframeId> keyframe_sharing_most(std::vector<PointId> seen) const;
};

}  // namespace tsg
