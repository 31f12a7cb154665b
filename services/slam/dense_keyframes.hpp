#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/geometry/se3.hpp"
#include "common/rgbd/instances.hpp"
#include "common/rgbd/rgbd_frame.hpp"
#include "services/slam/lib/ids.hpp"

namespace tsg {

/// Where a frame was taken: in `map` as known then, and relative to a keyframe of tracking, so that
/// later corrections can be followed.
struct KeyframePlace {
  SE3 T_map_camera = {};
  KeyframeId reference = 0;
  SE3 T_reference_camera = {};
};

/// A frame for the map server. Views: valid until the next call of DenseKeyframes.
struct DenseKeyframe {
  RgbdFrame frame;
  KeyframePlace place;
  /// The frame's own; absent where its mask did not come.
  std::optional<InstanceSegmentation> segmentation;
};

/// Decides which frames go to the map server: after each keyframe of tracking the first frame
/// whose own mask is known, as a late mask laid over a newer frame would leave people in the map.
/// Masks come a few frames late, for frames that nobody can foretell; so from a keyframe on frames
/// are copied until a mask of one of them is there. Without a mask in time the keyframe goes out
/// unlabelled.
class DenseKeyframes {
 public:
  /// `patience_ns`: how long to wait for a mask, by the frames' stamps.
  DenseKeyframes(bool expect_masks, std::int64_t patience_ns)
      : expect_masks_(expect_masks), patience_ns_(patience_ns) {}

  /// A tracked frame. `own_mask`: of this very frame, where it is known already, else null.
  std::optional<DenseKeyframe> add_frame(const RgbdFrame& frame,
                                         const KeyframePlace& place,
                                         bool is_keyframe,
                                         const InstanceSegmentation* own_mask);

  /// A mask has come, for an earlier frame.
  std::optional<DenseKeyframe> add_mask(const InstanceSegmentation& mask);

  /// What is still waiting, unlabelled: when there will be no more frames.
  std::optional<DenseKeyframe> flush();

  /// Keyframes that went out unlabelled although masks were expected.
  [[nodiscard]] std::uint64_t without_mask() const { return without_mask_; }

 private:
  struct Waiting {
    RgbdFrame frame;  // its images are ours
    KeyframePlace place;
  };
  void keep(const RgbdFrame& frame, const KeyframePlace& place);
  DenseKeyframe release(Waiting waiting, std::optional<InstanceSegmentation> segmentation);

  bool expect_masks_;
  std::int64_t patience_ns_;
  std::deque<Waiting> waiting_;  // the keyframe and all tracked frames after it
  std::optional<Waiting> released_;
  std::vector<RgbdFrame> spare_;  // their image memory is used again
  std::uint64_t without_mask_ = 0;
};

}  // namespace tsg
