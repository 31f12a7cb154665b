#pragma once

#include <cstdint>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "services/slam/dense_keyframes.hpp"

namespace tsg {

/// Sends keyframes to the map server through shared memory.
class KeyframePublisher {
 public:
  explicit KeyframePublisher(Bus& bus) : publisher_(bus) {}

  /// Notices map servers that join or leave; to be called several times a second.
  void watch_subscribers();

  /// kUnavailable where no memory is free, or a map server has joined just now: what is written
  /// before shared memory knows its reader is lost to it. Without any map server does nothing.
  Expected<void> publish(const DenseKeyframe& keyframe);

  [[nodiscard]] std::uint64_t sent() const { return sent_; }

 private:
  [[nodiscard]] bool is_settled() const;

  Publisher<topics::Keyframe> publisher_;
  int subscribers_ = 0;
  std::int64_t joined_ns_ = 0;  // when the last of them did, monotonic
  std::uint64_t sent_ = 0;
};

}  // namespace tsg
