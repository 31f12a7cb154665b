#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/geometry/stamped_pose.hpp"
#include "services/slam/lib/local_mapper.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// How the core is run over a recorded sequence.
struct OfflineOptions {
  SlamConfig slam;
  bool use_masks = true;              ///< the sequence's true masks, where it has some
  int mask_delay_frames = 0;          ///< a mask comes that many frames after its frame ...
  int mask_every_frames = 1;          ///< ... and only every so many frames is segmented at all
  std::size_t take_every_frames = 1;  ///< the others are skipped, as if the camera were faster
};

struct OfflineRun {
  Trajectory live;       ///< as tracked
  Trajectory corrected;  ///< by the keyframes' final poses
  std::vector<KeyframePose> keyframes;
  std::size_t frames = 0;
  std::vector<std::string> failures;  ///< frame and reason of each frame without a pose
  std::size_t map_keyframes = 0;
  std::size_t map_points = 0;
  std::uint64_t map_corrections = 0;  ///< by loops
  std::vector<double> extract_ms;     ///< wall-clock, one per frame
  std::vector<double> track_ms;
  std::vector<double> mapping_ms;  ///< one per keyframe
};

/// Runs tracking and mapping in turn over a TUM folder, as slam does in lockstep: no bus, no
/// threads. Throws FatalError where the sequence cannot be read.
[[nodiscard]] OfflineRun run_offline(const std::filesystem::path& folder,
                                     const OfflineOptions& options);

}  // namespace tsg
