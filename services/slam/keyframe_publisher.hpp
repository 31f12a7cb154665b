#pragma once

#include <cstdint>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "services/slam/dense_keyframes.hpp"
#include "services/slam/lib/local_mapper.hpp"

namespace tsg {

/// Sends keyframes to the map server through shared memory.
class KeyframePublisher {
 public:
  explicit KeyframePublisher(Bus& bus) : publisher_(bus), poses_(bus) {}

  /// Notices map servers that join or leave; to be called several times a second.
  void watch_subscribers();

  /// kUnavailable where no memory is free, or a map server has joined just now: what is written
  /// before shared memory knows its reader is lost to it. Without any map server does nothing.
  Expected<void> publish(const DenseKeyframe& keyframe);

  /// Tells where all keyframes that were sent are, now that the map was corrected. `corrected`
  /// (world, sorted by id): the keyframes of tracking.
  Expected<void> publish_poses(const std::vector<KeyframePose>& corrected);

  /// Another map: where those sent so far are is told no more.
  void forget_places() { placed_.clear(); }

  [[nodiscard]] std::uint64_t sent() const { return sent_; }

 private:
  /// A keyframe that was sent.
  struct Placed {
    std::uint64_t id = 0;
    std::int64_t stamp_ns = 0;
    KeyframeId reference = 0;
    SE3 T_reference_camera;
  };
  [[nodiscard]] bool is_settled() const;

  Publisher<topics::Keyframe> publisher_;
  Publisher<topics::KeyframePoses> poses_;
  std::vector<Placed> placed_;
  std::uint64_t corrections_ = 0;
  int subscribers_ = 0;
  std::int64_t joined_ns_ = 0;  // when the last of them did, monotonic
  std::uint64_t sent_ = 0;
};

}  // namespace tsg
