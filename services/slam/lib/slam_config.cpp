#include "services/slam/lib/slam_config.hpp"

#include <algorithm>
#include <cmath>

namespace tsg {
namespace {

/// Notes `problem` unless `sound`; NaN never makes a comparison true, so it is always noted.
void require(bool sound, const char* problem, std::vector<std::string>& problems) {
  if (!sound) problems.emplace_back(problem);
}

void append(const std::string& section,
            const std::vector<std::string>& problems,
            std::vector<std::string>& all) {
  for (const std::string& problem : problems) {
    std::string line = section;
    line += '.';
    line += problem;
    all.push_back(std::move(line));
  }
}

}  // namespace

std::vector<std::string> FeatureConfig::problems() const {
  std::vector<std::string> found;
  require(max_features >= 100 && max_features <= 10000, "max_features must be 100..10000", found);
  require(levels >= 1 && levels <= 12, "levels must be 1..12", found);
  require(scale_factor > 1.0 && scale_factor <= 2.0, "scale_factor must be in (1, 2]", found);
  require(min_fast_threshold >= 1, "min_fast_threshold must be >= 1", found);
  require(fast_threshold >= min_fast_threshold && fast_threshold <= 255,
          "fast_threshold must be min_fast_threshold..255", found);
  require(min_depth_m > 0.0, "min_depth_m must be > 0", found);
  require(max_depth_m > min_depth_m && std::isfinite(max_depth_m),
          "max_depth_m must be > min_depth_m", found);
  require(inverse_depth_sigma > 0.0 && std::isfinite(inverse_depth_sigma),
          "inverse_depth_sigma must be > 0", found);
  return found;
}

std::vector<std::string> DynamicFilterConfig::problems() const {
  std::vector<std::string> found;
  require(std::none_of(dynamic_classes.begin(), dynamic_classes.end(),
                       [this](const std::string& name) {
                         return std::find(potentially_dynamic_classes.begin(),
                                          potentially_dynamic_classes.end(),
                                          name) != potentially_dynamic_classes.end();
                       }),
          "potentially_dynamic_classes must not repeat a class of dynamic_classes", found);
  require(min_score >= 0.0 && min_score <= 1.0, "min_score must be 0..1", found);
  require(dilation_px >= 0.0 && dilation_px <= 100.0, "dilation_px must be 0..100", found);
  require(max_speed_mps >= 0.0 && std::isfinite(max_speed_mps), "max_speed_mps must be >= 0",
          found);
  require(depth_tolerance_m > 0.0 && std::isfinite(depth_tolerance_m),
          "depth_tolerance_m must be > 0", found);
  require(max_mask_age_frames >= 0, "max_mask_age_frames must be >= 0", found);
  return found;
}

std::vector<std::string> TrackerConfig::problems() const {
  std::vector<std::string> found;
  require(min_inliers >= 6, "min_inliers must be >= 6", found);
  require(min_features_to_start >= min_inliers, "min_features_to_start must be >= min_inliers",
          found);
  require(pixel_sigma > 0.0 && std::isfinite(pixel_sigma), "pixel_sigma must be > 0", found);
  require(keyframe_overlap > 0.0 && keyframe_overlap < 1.0, "keyframe_overlap must be in (0, 1)",
          found);
  require(standing_still > 0.0, "standing_still must be > 0", found);
  require(keyframe_view_change > standing_still && std::isfinite(keyframe_view_change),
          "keyframe_view_change must be > standing_still", found);
  require(new_part_after_s >= 0.0 && std::isfinite(new_part_after_s),
          "new_part_after_s must be >= 0", found);
  return found;
}

std::vector<std::string> MapperConfig::problems() const {
  std::vector<std::string> found;
  require(window_keyframes >= 2, "window_keyframes must be >= 2", found);
  require(fixed_keyframes >= 1, "fixed_keyframes must be >= 1", found);
  require(snapshot_keyframes >= 1, "snapshot_keyframes must be >= 1", found);
  require(snapshot_points >= 1000, "snapshot_points must be >= 1000", found);
  require(min_shared_points >= 1, "min_shared_points must be >= 1", found);
  require(max_iterations >= 1, "max_iterations must be >= 1", found);
  require(time_budget_s >= 0.0 && std::isfinite(time_budget_s), "time_budget_s must be >= 0",
          found);
  require(redundant_share > 0.5 && redundant_share <= 1.0, "redundant_share must be in (0.5, 1]",
          found);
  return found;
}

std::vector<std::string> LoopConfig::problems() const {
  std::vector<std::string> found;
  require(max_keyframes >= 1 && max_keyframes <= 65535, "max_keyframes must be 1..65535", found);
  require(min_inliers >= 12, "min_inliers must be >= 12", found);
  require(min_cells >= 1 && min_cells <= 16, "min_cells must be 1..16", found);
  require(max_contradiction >= 0.0 && max_contradiction < 1.0,
          "max_contradiction must be in [0, 1)", found);
  require(confirmations >= 1, "confirmations must be >= 1", found);
  require(max_drift_share > 0.0 && std::isfinite(max_drift_share), "max_drift_share must be > 0",
          found);
  return found;
}

std::vector<std::string> SlamConfig::problems() const {
  std::vector<std::string> found;
  append("features", features.problems(), found);
  append("dynamic_filter", dynamic_filter.problems(), found);
  append("tracker", tracker.problems(), found);
  append("mapper", mapper.problems(), found);
  append("loop", loop.problems(), found);
  return found;
}

}  // namespace tsg
