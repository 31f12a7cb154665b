#include "services/map_server/config.hpp"

namespace tsg {

std::vector<std::string> MapServerConfig::problems() const {
  std::vector<std::string> found = map.problems();
  if (queue_keyframes < 1 || queue_keyframes > 1000) {
    found.emplace_back("queue_keyframes must be 1..1000");
  }
  return found;
}

MapServerConfig load_map_server_config(const ConfigFile& file) {
  MapServerConfig config;
  MapConfig& map = config.map;
  ConfigReader reader(file, "map_server");
  reader.read("queue_keyframes", config.queue_keyframes);
  reader.read("resolution_m", map.octree.resolution_m);
  reader.read("cloud_voxel_m", map.cloud_voxel_m);
  reader.read("max_extent_m", map.max_extent_m);
  reader.read("depth.min_depth_m", map.depth.min_depth_m);
  reader.read("depth.max_depth_m", map.depth.max_depth_m);
  reader.read("depth.max_inverse_depth_step", map.depth.max_inverse_depth_step);
  reader.read("exclusion.dynamic_classes", map.exclusion.dynamic_classes);
  reader.read("exclusion.mask_margin_px", map.exclusion.margin_px);
  reader.read("exclusion.mask_growth_px", map.exclusion.growth_px);
  reader.read("exclusion.mask_growth_depth_ratio", map.exclusion.growth_depth_ratio);
  reader.read("outliers.neighbours", map.outliers.neighbours);
  reader.read("outliers.max_sigma", map.outliers.max_sigma);
  reader.read("outliers.kept_within_m", map.outliers.kept_within_m);
  reader.read("occupancy.hit_probability", map.octree.hit_probability);
  reader.read("occupancy.miss_probability", map.octree.miss_probability);
  reader.read("occupancy.min_probability", map.octree.min_probability);
  reader.read("occupancy.max_probability", map.octree.max_probability);
  reader.read("tags.voxel_m", map.tags.voxel_m);
  reader.read("tags.max_voxels", map.tags.max_voxels);
  reader.read("tags.min_points", map.tags.min_points);
  reader.read("tags.min_overlap", map.tags.min_overlap);
  reader.read("tags.sure_overlap", map.tags.sure_overlap);
  reader.read("tags.merge_overlap", map.tags.merge_overlap);
  reader.read("tags.min_confidence", map.tags.min_confidence);
  reader.read("tags.min_observations", map.tags.min_observations);
  reader.read("tags.gone_share", map.tags.gone_share);
  reader.read("tags.checks_per_keyframe", map.tags.checks_per_keyframe);
  reader.finish(config.problems());
  return config;
}

}  // namespace tsg
