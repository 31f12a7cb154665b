#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/features.hpp"

namespace tsg {

/// What is remembered of a frame to tell motion by.
struct PastFrame {
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;
  cv::Mat depth;  ///< of cells, metres
  std::shared_ptr<const Features> features =
      {};                                  ///< all, those on moving things too; null at first
  std::optional<SE3> T_world_camera = {};  ///< where tracking found one
};

/// The frames of the last seconds, every one of the last and some of the earlier.
class PastFrames {
 public:
  void add(PastFrame frame);

  /// The frame being judged; there must be one.
  [[nodiscard]] PastFrame& now() { return frames_.back(); }
  [[nodiscard]] const PastFrame& now() const { return frames_.back(); }
  /// The one before it; null where there is none.
  [[nodiscard]] const PastFrame* previous() const {
    return frames_.size() < 2 ? nullptr : &frames_[frames_.size() - 2];
  }
  /// Null where it is forgotten or never was.
  [[nodiscard]] PastFrame* find(std::uint64_t seq);
  [[nodiscard]] const PastFrame* find(std::uint64_t seq) const;
  /// The latest with a pose that is at least so much older than the frame being judged; null where
  /// there is none, or none younger than twice that.
  [[nodiscard]] const PastFrame* before(std::int64_t age_ns) const;

  void move_world(const SE3& T_moved_world);
  void forget_poses();

 private:
  std::deque<PastFrame> frames_;  ///< by time
};

}  // namespace tsg
