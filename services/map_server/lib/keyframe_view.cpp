#include "services/map_server/lib/keyframe_view.hpp"

#include <utility>

namespace tsg {
namespace {

/// The points of each instance of `keyframe`, unfiltered.
std::vector<InstanceView> instances_of(const MapKeyframe& keyframe, const KeyframeCloud& cloud) {
  std::vector<InstanceView> views;
  for (const Instance& instance : keyframe.instances.instances) views.push_back({instance, {}});
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const std::size_t label = cloud.label_of_point[i];
    if (label > 0) views[label - 1].points.push_back(cloud.points[i]);
  }
  return views;
}

}  // namespace

KeyframeViewer::KeyframeViewer(const DepthFilterConfig& depth,
                               const ExclusionConfig& exclusion,
                               double voxel_m)
    : projector_(depth, exclusion), grid_(voxel_m) {}

KeyframeView KeyframeViewer::view(const MapKeyframe& keyframe, ClassTable& classes) {
  KeyframeCloud cloud = projector_.project(keyframe, classes);
  KeyframeView view;
  view.id = keyframe.id;
  view.stamp_ns = keyframe.frame.stamp_ns;
  view.has_labels = keyframe.has_labels;
  view.points_raw = cloud.points.size();
  view.instances = instances_of(keyframe, cloud);
  for (InstanceView& instance : view.instances) {
    instance.points = voxel_filter(instance.points, grid_);
  }
  view.points = voxel_filter(cloud.points, grid_);
  view.free_ends = std::move(cloud.free_ends);
  return view;
}

}  // namespace tsg
