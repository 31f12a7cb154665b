#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/se3.hpp"
#include "common/rgbd/instances.hpp"
#include "common/rgbd/rgbd_frame.hpp"
#include "services/slam/lib/dynamic/frame_verdicts.hpp"
#include "services/slam/lib/keyframe_candidate.hpp"
#include "services/slam/lib/local_map_snapshot.hpp"
#include "services/slam/lib/pose_optimizer.hpp"
#include "services/slam/lib/slam_config.hpp"
#include "services/slam/lib/tracking_stage.hpp"

namespace tsg {

enum class TrackingState {
  kInitialising,  ///< no map yet: the view has too few features with depth to start one
  kTracking,
  kLost,  ///< no pose; every frame tries to find the map again
};

/// World is the optical frame of the keyframe that began the part of the map: x right, y down, z
/// forward.
struct TrackResult {
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;
  TrackingState state = TrackingState::kInitialising;
  std::optional<SE3> T_world_camera = {};  ///< set exactly when state == kTracking
  MapPart part = 0;                        ///< of the map, whose world it is
  KeyframeId reference = 0;                ///< the keyframe that shares most map points
  SE3 T_reference_camera = {};             ///< the same pose, relative to it
  /// How uncertain the pose is in the map as it is: of a left-hand twist of T_camera_world,
  /// translation (m) first, then rotation (rad). Drift of the map is not in it.
  Matrix6d covariance = Matrix6d::Zero();
  /// The way from the previous frame's camera, both poses by the same map: free of what was
  /// corrected in between. Set exactly where the previous frame was tracked too.
  std::optional<SE3> T_previous_camera = {};
  bool relocalised = false;  ///< tracking again after it was lost, maybe in a new part of the map
  int matches = 0;           ///< features matched to points of the map or the last frame
  int inliers = 0;           ///< of these, kept by the last pose optimisation
  FeatureCounts features;
  int mask_age_frames = -1;
  std::shared_ptr<const FrameVerdicts> verdicts = {};  ///< on all features that were detected
  std::string reason = {};                         ///< why there is no pose; empty while tracking
  std::optional<KeyframeCandidate> keyframe = {};  ///< for LocalMapper::insert
  std::vector<PointId> dynamic_points = {};        ///< for LocalMapper::remove_points: found to lie
                                                   ///< on dynamic instances once their mask came
};

/// Finds the camera's pose in the local map, frame by frame. Where `map` has keyframes before the
/// first frame, the camera is lost in a known map and looks for its place there; else the first
/// frame starts the map.
/// Deterministic; not thread-safe: the tracking thread owns it.
class Tracker {
 public:
  /// `on_stage`, if given, is called when a stage begins: libraries have no clock, nodes do.
  Tracker(const SlamConfig& config,
          const CameraModel& camera,
          std::function<void(TrackingStage)> on_stage = {});
  ~Tracker();
  Tracker(Tracker&& other) noexcept;
  Tracker& operator=(Tracker&& other) noexcept;
  Tracker(const Tracker& other) = delete;
  Tracker& operator=(const Tracker& other) = delete;

  /// Features of `frame` without those on dynamic instances. `mask` may be null; it may belong to
  /// an older frame and is then carried forward to this one. Both are only read during the call.
  /// The images must have the camera's size and the types of RgbdFrame (checked by the node).
  [[nodiscard]] std::shared_ptr<const Features> extract(const RgbdFrame& frame,
                                                        const InstanceSegmentation* mask);

  /// The pose of the frame that `features` belong to. Call with the frames in their order. A
  /// keyframe that is proposed must be inserted: no other is until `map` shows it.
  [[nodiscard]] TrackResult track(const std::shared_ptr<const Features>& features,
                                  const LocalMapSnapshot& map);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tsg
