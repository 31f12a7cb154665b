#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "common/rgbd/instances.hpp"

namespace tsg {

/// The newest instance mask, copied out of shared memory.
class MaskInput {
 public:
  explicit MaskInput(Bus& bus) : masks_(bus) {}

  /// Takes in what has come; true where there is a newer mask than before.
  bool update();
  /// Waits for the mask of frame `seq`; false on timeout or stop.
  bool wait_for(std::uint64_t seq, std::chrono::milliseconds timeout, const std::stop_token& stop);

  /// Null before the first one.
  [[nodiscard]] const InstanceSegmentation* newest() const { return newest_ ? &*newest_ : nullptr; }
  [[nodiscard]] bool has_source() const { return masks_.publisher_count() > 0; }
  [[nodiscard]] std::uint64_t received() const { return received_; }
  /// Masks that made no sense.
  [[nodiscard]] std::uint64_t rejected() const { return rejected_; }

 private:
  void accept(const tsg_InstanceMask& message);

  Subscriber<topics::Instances> masks_;
  std::optional<InstanceSegmentation> newest_;
  std::uint64_t received_ = 0;
  std::uint64_t rejected_ = 0;
};

}  // namespace tsg
