#pragma once

#include <string>
#include <vector>

#include "services/slam/lib/dynamic/method.hpp"

namespace tsg {

/// Which features are looked for, and which depth is believed.
struct FeatureConfig {
  int max_features = 1000;     // more gains no accuracy at VGA and costs time in every stage
  int levels = 8;              // of the image pyramid: scale change 1.2^7 = 3.6
  double scale_factor = 1.2;   // between levels; steps of 1.2 keep ORB matches across levels
  int fast_threshold = 20;     // grey values; corners that survive noise and blur
  int min_fast_threshold = 7;  // where a cell of the image has no such corner
  double min_depth_m = 0.3;    // nearer than a Kinect-like sensor can measure
  double max_depth_m = 8.0;    // beyond it the sensor's bias exceeds its noise model
  double inverse_depth_sigma = 0.003;  // 1/m; structured light: sigma_z = this * z^2

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// What the classes of instances say about motion, and how far a late mask is trusted.
struct DynamicFilterConfig {
  DynamicMethod method = DynamicMethod::kFull;
  std::vector<std::string> dynamic_classes = {"person",     "bird",  "cat", "dog",
                                              "horse",      "sheep", "cow", "bicycle",
                                              "motorcycle", "car",   "bus", "truck"};
  /// Counted apart; they are kept, as most of the time they stand still.
  std::vector<std::string> potentially_dynamic_classes = {
      "chair", "suitcase", "backpack", "handbag", "umbrella", "sports ball", "laptop", "book"};
  double min_score = 0.25;          // less certain instances are as often wrong as right
  double dilation_px = 4.0;         // masks are cut a few pixels short
  double max_speed_mps = 1.5;       // of a person's limb relative to the body, for late masks
  double depth_tolerance_m = 0.25;  // half the thickness of a body
  int max_mask_age_frames = 15;     // later than half a second a mask says nothing

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// When a frame counts as tracked, and when it becomes a keyframe.
struct TrackerConfig {
  int min_features_to_start = 100;    // with depth; fewer make a map that tracking soon falls off
  int min_inliers = 20;               // 6 unknowns; fewer agree by chance in repetitive texture
  double pixel_sigma = 0.8;           // of a corner in level 0, pixels
  double keyframe_overlap = 0.8;      // insert below this share of the features found in the map
  double keyframe_view_change = 0.1;  // insert beyond it: translation / depth of scene, or radians
  double standing_still = 0.02;       // never insert below it, the same measure
  double new_part_after_s = 3.0;      // lost for so long: begin a new part of the map; 0 = never
  bool localisation_only = false;  // the map is given and stays as it is: no keyframe, no removal

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// How large the local map is and how hard it is optimised.
struct MapperConfig {
  int window_keyframes = 10;     // optimised together; more cost time, gain little
  int fixed_keyframes = 20;      // at most so many outer keyframes hold the gauge
  int snapshot_keyframes = 30;   // whose points tracking may match
  int snapshot_points = 12000;   // bounds tracking time and memory
  int min_shared_points = 15;    // two keyframes are neighbours from here on
  int max_iterations = 10;       // of local bundle adjustment
  double time_budget_s = 0.0;    // of local bundle adjustment; 0 = none (reproducible runs)
  double redundant_share = 0.9;  // of points seen by >= 3 others: keyframe is culled

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// When a place counts as seen before. All of it errs on the side of no loop.
struct LoopConfig {
  bool enabled = true;
  int max_keyframes = 2000;         // that can be recognised; bounds memory: about 50 kB each
  int min_inliers = 50;             // of a keyframe's features on the points of the place
  int min_cells = 6;                // of 16 in the image that hold one: a poster alone has fewer
  double max_contradiction = 0.12;  // share of depth that is seen through what should be there
  int confirmations = 3;            // keyframes that must tell the same correction
  double max_drift_share = 0.05;    // metres, or radians, that a metre of the path may drift

  [[nodiscard]] std::vector<std::string> problems() const;
};

struct SlamConfig {
  FeatureConfig features;
  DynamicFilterConfig dynamic_filter;
  TrackerConfig tracker;
  MapperConfig mapper;
  LoopConfig loop;

  /// What makes it unusable, a sentence each with the key's name; empty where it is sound.
  [[nodiscard]] std::vector<std::string> problems() const;
};

}  // namespace tsg
