#include "services/slam/config.hpp"

#include <utility>

namespace tsg {
namespace {

void read_features(ConfigReader& reader, FeatureConfig& config) {
  reader.read("features.max_features", config.max_features);
  reader.read("features.levels", config.levels);
  reader.read("features.scale_factor", config.scale_factor);
  reader.read("features.fast_threshold", config.fast_threshold);
  reader.read("features.min_fast_threshold", config.min_fast_threshold);
  reader.read("features.min_depth_m", config.min_depth_m);
  reader.read("features.max_depth_m", config.max_depth_m);
  reader.read("features.inverse_depth_sigma", config.inverse_depth_sigma);
}

/// The problem with the name of the method, or nothing.
std::vector<std::string> read_method(ConfigReader& reader, DynamicMethod& method) {
  std::string name(name_of(method));
  reader.read("dynamic_filter.method", name);
  const auto named = method_named(name);
  if (!named) return {"dynamic_filter.method must be none, mask, epipolar, tsg or full"};
  method = *named;
  return {};
}

void read_dynamic_filter(ConfigReader& reader, DynamicFilterConfig& config) {
  reader.read("dynamic_filter.dynamic_classes", config.dynamic_classes);
  reader.read("dynamic_filter.potentially_dynamic_classes", config.potentially_dynamic_classes);
  reader.read("dynamic_filter.min_score", config.min_score);
  reader.read("dynamic_filter.dilation_px", config.dilation_px);
  reader.read("dynamic_filter.max_speed_mps", config.max_speed_mps);
  reader.read("dynamic_filter.depth_tolerance_m", config.depth_tolerance_m);
  reader.read("dynamic_filter.max_mask_age_frames", config.max_mask_age_frames);
}

void read_tracker(ConfigReader& reader, TrackerConfig& config) {
  reader.read("tracker.min_features_to_start", config.min_features_to_start);
  reader.read("tracker.min_inliers", config.min_inliers);
  reader.read("tracker.pixel_sigma", config.pixel_sigma);
  reader.read("tracker.keyframe_overlap", config.keyframe_overlap);
  reader.read("tracker.keyframe_view_change", config.keyframe_view_change);
  reader.read("tracker.standing_still", config.standing_still);
  reader.read("tracker.new_part_after_s", config.new_part_after_s);
}

void read_mapper(ConfigReader& reader, MapperConfig& config) {
  reader.read("mapper.window_keyframes", config.window_keyframes);
  reader.read("mapper.fixed_keyframes", config.fixed_keyframes);
  reader.read("mapper.snapshot_keyframes", config.snapshot_keyframes);
  reader.read("mapper.snapshot_points", config.snapshot_points);
  reader.read("mapper.min_shared_points", config.min_shared_points);
  reader.read("mapper.max_iterations", config.max_iterations);
  reader.read("mapper.time_budget_s", config.time_budget_s);
  reader.read("mapper.redundant_share", config.redundant_share);
}

void read_loop(ConfigReader& reader, LoopConfig& config) {
  reader.read("loop.enabled", config.enabled);
  reader.read("loop.max_keyframes", config.max_keyframes);
  reader.read("loop.min_inliers", config.min_inliers);
  reader.read("loop.min_cells", config.min_cells);
  reader.read("loop.max_contradiction", config.max_contradiction);
  reader.read("loop.confirmations", config.confirmations);
  reader.read("loop.max_drift_share", config.max_drift_share);
}

}  // namespace

std::vector<std::string> SlamNodeConfig::problems() const {
  std::vector<std::string> found = core.problems();
  if (core.tracker.localisation_only && map_to_load.empty()) {
    found.emplace_back("map.localisation_only needs a map: set map.load to a map file");
  }
  if (!(lockstep_mask_wait_s > 0.0)) found.emplace_back("lockstep_mask_wait_s must be > 0");
  if (!(keyframe_mask_wait_s > 0.0)) found.emplace_back("keyframe_mask_wait_s must be > 0");
  if (lockstep && core.mapper.time_budget_s > 0.0) {
    found.emplace_back(
        "mapper.time_budget_s must be 0 with lockstep, which promises equal results");
  }
  return found;
}

SlamNodeConfig load_slam_config(const ConfigFile& file) {
  SlamNodeConfig config;
  ConfigReader reader(file, "slam");
  reader.read("map.load", config.map_to_load);
  reader.read("map.localisation_only", config.core.tracker.localisation_only);
  reader.read("lockstep", config.lockstep);
  reader.read("expect_masks", config.expect_masks);
  reader.read("lockstep_mask_wait_s", config.lockstep_mask_wait_s);
  reader.read("keyframe_mask_wait_s", config.keyframe_mask_wait_s);
  read_features(reader, config.core.features);
  std::vector<std::string> problems = read_method(reader, config.core.dynamic_filter.method);
  read_dynamic_filter(reader, config.core.dynamic_filter);
  read_tracker(reader, config.core.tracker);
  read_mapper(reader, config.core.mapper);
  read_loop(reader, config.core.loop);
  for (std::string& problem : config.problems()) problems.push_back(std::move(problem));
  reader.finish(problems);
  return config;
}

}  // namespace tsg
