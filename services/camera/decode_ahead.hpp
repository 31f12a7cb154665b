#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <thread>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "common/core/bounded_queue.hpp"
#include "services/camera/lib/frame_source.hpp"

namespace tsg {

/// A frame on its way from the source to the bus.
struct FrameInFlight {
  std::uint64_t seq = 0;
  std::unique_ptr<PendingFrame> frame;
  Loan<topics::Rgbd> loan;      ///< what it is decoded into
  Expected<void> decoded = {};  ///< why that failed
  std::int64_t decode_ns = 0;
};

/// Decodes frames into shared memory on a thread of its own, so that a frame is ready when it is
/// due. One owner submits and takes; frames come back in the order in which they went in.
class DecodeAhead {
 public:
  /// At most `capacity` frames may be in flight. Frames are of the camera of `info`, which fits
  /// into a sample.
  DecodeAhead(const SourceInfo& info, std::size_t capacity);

  void submit(FrameInFlight frame);
  /// Waits for the oldest frame in flight, of which there must be one; nothing on stop.
  [[nodiscard]] std::optional<FrameInFlight> take(const std::stop_token& stop);
  [[nodiscard]] std::size_t in_flight() const { return in_flight_; }

 private:
  void run(const std::stop_token& stop);
  void decode(FrameInFlight& frame) const;

  SourceInfo info_;
  std::size_t capacity_;
  std::size_t in_flight_ = 0;
  BoundedQueue<FrameInFlight> submitted_;
  BoundedQueue<FrameInFlight> decoded_;
  std::jthread thread_;  // last: ends before the queues
};

}  // namespace tsg
