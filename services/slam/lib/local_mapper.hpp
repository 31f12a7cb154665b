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

struct MapContents;

/// Where a keyframe is, by the latest optimisation.
struct KeyframePose {
  KeyframeId id = 0;
  std::uint64_t seq = 0;  ///< of its RgbdFrame
  std::int64_t stamp_ns = 0;
  SE3 T_world_camera;
  MapPart part = 0;  ///< whose world it is
};

/// Owns the map: takes keyframes in, makes and merges map points, adjusts the newest part.
/// Deterministic as long as no time budget is set and `stop` is not requested. Not thread-safe:
/// the mapping thread owns it; others get snapshots.
class LocalMapper {
 public:
  LocalMapper(const SlamConfig& config, const CameraModel& camera);
  /// Goes on with a map that was kept. Its keyframes are of an earlier session, whose masks and
  /// frame numbers have nothing to do with those to come.
  LocalMapper(const SlamConfig& config, MapContents&& contents);
  ~LocalMapper();
  LocalMapper(LocalMapper&& other) noexcept;
  LocalMapper& operator=(LocalMapper&& other) noexcept;
  LocalMapper(const LocalMapper& other) = delete;
  LocalMapper& operator=(const LocalMapper& other) = delete;

  /// Adds the keyframe with new map points from its depth; fuses duplicates with its neighbours;
  /// where there is no depth, makes points of what it sees together with a neighbour.
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
  /// map that looks like it, until a keyframe comes. As it was where nothing does.
  void recall(const Features& view);

  /// Makes the snapshot the part of the map around keyframe `id`, until the map changes: for a
  /// camera that moves in a map that does not grow. Does nothing where there is no such keyframe.
  void centre_on(KeyframeId id);

  /// The local map as it is now; the same object until the map changes.
  [[nodiscard]] std::shared_ptr<const LocalMapSnapshot> snapshot();

  /// Every keyframe ever inserted, oldest first; culled ones move along with a neighbour.
  [[nodiscard]] std::vector<KeyframePose> keyframe_poses() const;

  /// A copy of the whole map; what is large in it, the features, is shared.
  [[nodiscard]] MapContents contents() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tsg
