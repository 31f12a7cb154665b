#pragma once

#include <string>
#include <vector>

#include "common/app/config_file.hpp"
#include "services/camera/lib/replay_source.hpp"

namespace tsg {

/// A simulated room instead of a recording. 0: as the scene says.
struct SimulationConfig {
  std::string scene;  ///< a shipped scene, or the path of a file; must be given
  int seed = 0;
  int width = 0;  ///< both or neither
  int height = 0;
  double rate_hz = 0.0;
  bool endless = false;  ///< goes on after the scene's duration
};

/// Section "camera" of the configuration.
struct CameraConfig {
  std::string source = "replay";  ///< or "simulation"
  std::string pace = "realtime";  ///< or "lockstep": the next frame when slam has answered
  ReplayConfig replay;
  SimulationConfig simulation;
  int wait_for_subscribers = 1;  ///< readers of tsg/rgbd before the first frame; 0: do not wait
  double subscriber_timeout_s = 30.0;  ///< slam and segmentation start in a few seconds
  double lockstep_timeout_s = 30.0;    ///< local mapping on a slow machine may take a while
  int read_ahead_frames = 4;           ///< decoded ahead: what a stall of decoding may cost; <= 7,
                                       ///< since a writer may hold eight loans at most
  double drain_s = 0.5;                ///< how long the last frames stay readable after the end

  [[nodiscard]] bool is_lockstep() const { return pace == "lockstep"; }
  /// What is wrong with it, each starting with the name of its key.
  [[nodiscard]] std::vector<std::string> problems() const;
};

/// Throws FatalError (kConfig) listing all that is wrong.
[[nodiscard]] CameraConfig load_camera_config(const ConfigFile& file);

}  // namespace tsg
