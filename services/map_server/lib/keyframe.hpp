#pragma once

#include <cstdint>

#include "common/core/error.hpp"
#include "common/geometry/se3.hpp"
#include "common/rgbd/instances.hpp"
#include "common/rgbd/rgbd_frame.hpp"

namespace tsg {

/// A frame that the map keeps, with its place. (slam's Keyframe is another: features and points.)
struct MapKeyframe {
  std::uint64_t id = 0;
  SE3 T_world_camera;
  RgbdFrame frame;
  bool has_labels = false;         ///< false: no mask of this frame came in time
  InstanceSegmentation instances;  ///< empty where has_labels is false
};

/// Says why a keyframe cannot go into a map whose content lies within `max_extent_m` of the origin
/// along each axis: pose, image sizes and types, labels without an instance, no depth at all.
[[nodiscard]] Expected<void> check_keyframe(const MapKeyframe& keyframe, double max_extent_m);

}  // namespace tsg
