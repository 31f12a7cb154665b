#include "services/slam/lib/depth_points.hpp"

namespace tsg {

std::vector<PointId> add_points_from_depth(Map& map,
                                           const ObservationModel& model,
                                           Keyframe& keyframe) {
  std::vector<PointId> added;
  for (std::size_t i = 0; i < keyframe.points.size(); ++i) {
    const Feature& feature = keyframe.features->items[i];
    if (keyframe.points[i] != kNoPoint || keyframe.banned[i] || !feature.has_depth()) continue;
    const Eigen::Vector3d p_camera =
        model.camera().unproject(feature.pixel.cast<double>(), 1.0 / feature.inverse_depth);
    const PointId id =
        map.add_point(keyframe.T_world_camera * p_camera, keyframe, static_cast<int>(i));
    map.update_appearance(*map.find_point(id), model);
    added.push_back(id);
  }
  return added;
}

}  // namespace tsg
