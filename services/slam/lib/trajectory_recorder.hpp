#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/stamped_pose.hpp"
#include "services/slam/lib/local_mapper.hpp"
#include "services/slam/lib/tracker.hpp"

namespace tsg {

/// Remembers every tracked frame relative to its reference keyframe, so that what bundle
/// adjustment learns later corrects the frames before as well.
class TrajectoryRecorder {
 public:
  /// Frames without a pose are counted, not recorded.
  void record(const TrackResult& result);

  /// Poses as they were when each frame was tracked, of those that were in `part` of the map then.
  [[nodiscard]] Trajectory live(MapPart part) const;
  /// Poses by where the keyframes are now, of the frames in the longest part of the map: the worlds
  /// of parts have nothing to do with each other. `keyframes` must be sorted by id and hold every
  /// reference (LocalMapper::keyframe_poses()); frames whose reference is not there are left out.
  [[nodiscard]] Trajectory corrected(const std::vector<KeyframePose>& keyframes) const;

  /// The part of the map in which most frames were tracked, the older one of two equals.
  [[nodiscard]] MapPart longest_part(const std::vector<KeyframePose>& keyframes) const;

  [[nodiscard]] std::size_t tracked() const { return entries_.size(); }
  [[nodiscard]] std::size_t lost() const { return lost_; }  ///< after the first pose

 private:
  struct Entry {
    std::int64_t stamp_ns;
    MapPart part;
    KeyframeId reference;
    SE3 T_reference_camera;
    SE3 T_world_camera;
  };
  std::vector<Entry> entries_;
  std::size_t lost_ = 0;
};

}  // namespace tsg
