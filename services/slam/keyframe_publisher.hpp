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

  Expected<void> publish(const DenseKeyframe& keyframe);

  [[nodiscard]] std::uint64_t sent() const { return sent_; }
  [[nodiscard]] bool has_subscriber() const { return publisher_.subscriber_count() > 0; }

 private:
  Publisher<topics::Keyframe> publisher_;
  std::uint64_t sent_ = 0;
};

}  // namespace tsg
