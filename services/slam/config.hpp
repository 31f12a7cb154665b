#pragma once

#include <string>
#include <vector>

#include "common/app/config_file.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// How the service drives the library.
struct SlamNodeConfig {
  SlamConfig core;
  /// Map file to start in; empty: a new map. With core.tracker.localisation_only it stays as it is.
  std::string map_to_load;
  /// For evaluation: waits for the mask of every frame and maps before it answers, so that equal
  /// input gives equal output. False on a robot: tracking waits for nothing.
  bool lockstep = false;
  /// Whether a segmentation service is there. Without one keyframes go out unlabelled at once.
  bool expect_masks = true;
  double lockstep_mask_wait_s = 30.0;  // a network on a busy machine; longer means it is dead
  double keyframe_mask_wait_s = 1.0;   // in real time; then the map gets the keyframe unlabelled

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// Reads section "slam". Throws FatalError (kConfig) naming everything that is wrong.
[[nodiscard]] SlamNodeConfig load_slam_config(const ConfigFile& file);

}  // namespace tsg
