#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/rgbd/instances.hpp"
#include "services/map_server/lib/back_projection.hpp"
#include "services/map_server/lib/class_table.hpp"
#include "services/map_server/lib/cloud.hpp"
#include "services/map_server/lib/keyframe.hpp"
#include "services/map_server/lib/voxel_grid.hpp"

namespace tsg {

/// One instance as a keyframe shows it.
struct InstanceView {
  Instance instance;
  Cloud points;  ///< camera axes, metres, voxel-filtered; empty where the map must not hold it
};

/// What the map needs of a keyframe, in camera axes: enough to put it at another place later
/// without its images. Paper eq. 5-6, after the voxel filter.
struct KeyframeView {
  std::uint64_t id = 0;
  std::int64_t stamp_ns = 0;
  bool has_labels = false;
  std::size_t points_raw = 0;  ///< pixels that became points
  Cloud points;                ///< metres; those of instances are among them
  /// Ends of rays that met nothing within the range of the map: the space up to them is free.
  std::vector<Eigen::Vector3f> free_ends;
  std::vector<InstanceView> instances;  ///< in the order of the keyframe's
};

/// Makes views of keyframes. One owner.
class KeyframeViewer {
 public:
  KeyframeViewer(const DepthFilterConfig& depth, const ExclusionConfig& exclusion, double voxel_m);

  /// `keyframe` must have passed check_keyframe(). New class names are added to `classes`.
  [[nodiscard]] KeyframeView view(const MapKeyframe& keyframe, ClassTable& classes);

 private:
  BackProjector projector_;
  VoxelGrid grid_;  // of the cloud being filtered
};

}  // namespace tsg
