#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/dataset/tum_folder.hpp"
#include "common/geometry/stamped_pose.hpp"
#include "services/slam/lib/local_mapper.hpp"
#include "services/slam/lib/map_contents.hpp"
#include "services/slam/lib/slam_config.hpp"
#include "services/slam/lib/tracker.hpp"
#include "services/slam/offline/mask_source.hpp"
#include "services/slam/offline/stage_clock.hpp"

namespace tsg {

/// How the core is run over a recorded sequence.
struct OfflineOptions {
  SlamConfig slam = {};
  MaskOptions masks = {};
  std::size_t first_frame = 0;                                      ///< index in the sequence
  std::size_t end_frame = std::numeric_limits<std::size_t>::max();  ///< one beyond the last
  std::size_t take_every_frames = 1;  ///< the others are skipped, as if the camera were faster
  std::shared_ptr<const MapContents> map = {};  ///< to start in; null: a new map
  int laps = 1;  ///< how often the sequence is gone through; its path should be closed for more
};

/// One frame as it has just been done. Pointers are valid during the call only.
struct OfflineFrame {
  std::uint64_t seq = 0;  ///< counts on over laps
  int lap = 0;
  TrackingState state = TrackingState::kInitialising;
  std::optional<SE3> T_world_camera = {};              ///< while tracking
  std::int64_t recorded_ns = 0;                        ///< its stamp in the sequence's files
  const RgbdFrame* image = nullptr;                    ///< never null in on_frame
  const InstanceSegmentation* mask = nullptr;          ///< the latest that had come; null: none yet
  std::shared_ptr<const FrameVerdicts> verdicts = {};  ///< never null in on_frame
  bool is_keyframe = false;
  FrameCost cost = {};
  std::size_t map_keyframes = 0;
  std::size_t map_points = 0;
};

/// What the caller adds: libraries have no clock.
struct OfflineHooks {
  std::function<std::int64_t()> now_ns = {};  ///< measures stages; empty: nothing is measured
  std::function<void(const OfflineFrame&)> on_frame = {};
};

struct OfflineRun {
  Trajectory live;                      ///< as tracked
  Trajectory corrected;                 ///< by the keyframes' final poses
  std::vector<KeyframePose> keyframes;  ///< all that there ever were
  std::size_t frames = 0;
  std::vector<std::string> failures;  ///< frame and reason of each frame without a pose
  std::size_t map_keyframes = 0;      ///< that are left in the map
  std::size_t map_points = 0;
  std::uint64_t map_corrections = 0;       ///< by loops
  std::size_t loops = 0;                   ///< closed
  std::shared_ptr<const MapContents> map;  ///< at the end
};

/// Runs tracking and mapping in turn over a sequence, as slam does in lockstep: no bus, no threads.
/// OpenCV's own threads are switched off for the whole process (cv::setNumThreads(1)), so that the
/// CPU time of the calling thread is all there is. Errors are those of reading the sequence.
[[nodiscard]] Expected<OfflineRun> run_offline(const TumFolder& sequence,
                                               const OfflineOptions& options,
                                               const OfflineHooks& hooks = {});

}  // namespace tsg
