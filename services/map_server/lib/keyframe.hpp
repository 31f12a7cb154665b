#pragma once

#include <cstdint>

#include "common/core/error.hpp"
#include "common/geometry/se3.hpp"
#include "common/rgbd/instances.hpp"
#include "common/rgbd/rgbd_frame.hpp"

namespace tsg {

// slam has a Keyframe of its own, and tsgctl holds both libraries: one name for the linker each.
inline namespace mapped {

/// A frame that the map keeps, with its place.
struct Keyframe {
  std::uint64_t id = 0;
  SE3 T_world_camera;
  RgbdFrame frame;
  bool has_labels = false;         ///< false: no mask of this frame came in time
  InstanceSegmentation instances;  ///< empty where has_labels is false
};

}  // namespace mapped

/// Says why a keyframe cannot go into a map whose content lies within `max_extent_m` of the origin
/// along each axis: pose, image sizes and types, labels without an instance, no depth at all.
[[nodiscard]] Expected<void> check_keyframe(const Keyframe& keyframe, double max_extent_m);

}  // namespace tsg
