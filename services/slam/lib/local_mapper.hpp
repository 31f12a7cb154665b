#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

#include "common/geometry/camera_model.hpp"
#include "common/rgbd/instances.hpp"
#include "services/slam/lib/keyframe_candidate.hpp"
#include "services/slam/lib/local_map_snapshot.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Where a keyframe is, by the latest optimisation.
struct KeyframePose {
  KeyframeId id = 0;
  std::uint64_t seq = 0;  ///< of its RgbdFrame
  std::int64_t stamp_ns = 0;
  SE3 T_world_camera;
};

/// Owns the map: takes keyframes in, makes and merges map points, adjusts the newest part.
/// Deterministic as long as no time budget is set and `stop` is not requested. Not thread-safe:
/// the mapping thread owns it; others get snapshots.
class LocalMapper {
 public:
  LocalMapper(const SlamConfig& config, const CameraModel& camera);
  ~LocalMapper();
  LocalMapper(LocalMapper&& other) noexcept;
  LocalMapper& operator=(LocalMapper&& other) noexcept;
  LocalMapper(const LocalMapper& other) = delete;
  LocalMapper& operator=(const LocalMapper& other) = delete;

  /// Adds the keyframe with new map points from its depth; fuses duplicates with its neighbours.
  void insert(KeyframeCandidate&& candidate);

  /// Local bundle adjustment around the newest keyframe, then removal of what proved bad or
  /// redundant; where the keyframe closes a loop, the whole map is corrected. Returns early, with a
  /// valid map, once `stop` is requested.
  void refine(const std::stop_token& stop);

  /// After a loop: whether the full adjustment of the map is not done yet.
  [[nodiscard]] bool is_adjusting() const;
  /// Goes on with it until it is done or `must_stop` (asked after each iteration; may be empty)
  /// says so. Keyframes may be inserted between two calls.
  void adjust(const std::function<bool()>& must_stop);

  /// Takes map points out, and with them their observations; unknown ids are ignored.
  void remove_points(const std::vector<PointId>& points);

  /// To be called with the exact mask of a frame when it comes after the frame became a keyframe:
  /// takes out what the keyframe saw on dynamic instances. False if no keyframe has that seq.
  bool apply_mask(const InstanceSegmentation& mask);

  /// Tracking has lost the camera, and this is what it sees: the snapshot becomes the part of the
  /// map that looks like it, until the map changes. As it was where nothing does.
  void recall(const Features& view);

  /// The local map as it is now; the same object until the map changes.
  [[nodiscard]] std::shared_ptr<const LocalMapSnapshot> snapshot();

  /// Every keyframe ever inserted, oldest first; culled ones move along with a neighbour.
  [[nodiscard]] std::vector<KeyframePose> keyframe_poses() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tsg
