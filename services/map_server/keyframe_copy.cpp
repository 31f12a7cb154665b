#include "services/map_server/keyframe_copy.hpp"

#include <utility>

#include "common/bus/convert.hpp"

namespace tsg {

Expected<MapKeyframe> copy_keyframe(const tsg_Keyframe& message) {
  auto T_world_camera = to_se3(message.T_world_camera);
  if (!T_world_camera) return tl::unexpected(T_world_camera.error());
  auto frame = view_as_frame(message);
  if (!frame) return tl::unexpected(frame.error());
  auto instances = view_as_instances(message);
  if (!instances) return tl::unexpected(instances.error());

  MapKeyframe keyframe{message.id, *T_world_camera, std::move(*frame), message.has_labels,
                       std::move(*instances)};
  keyframe.frame.colour = keyframe.frame.colour.clone();
  keyframe.frame.depth = keyframe.frame.depth.clone();
  keyframe.instances.labels = keyframe.instances.labels.clone();
  return keyframe;
}

}  // namespace tsg
