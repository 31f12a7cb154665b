#pragma once

#include <array>
#include <cstdint>

#include "common/core/sample_window.hpp"
#include "common/core/time.hpp"
#include "services/slam/lib/tracker.hpp"

namespace tsg {

/// Wall-clock times of one frame, nanoseconds.
struct FrameTimes {
  std::int64_t extract_ns = 0;
  std::int64_t match_ns = 0;
  std::int64_t optimise_ns = 0;
  std::int64_t total_ns = 0;    ///< from the frame in hand to the pose handed to the bus
  std::int64_t latency_ns = 0;  ///< from the camera's publishing to the pose handed to the bus
};

/// Measures the stages of tracking as they report their beginnings.
class StageTimer {
 public:
  /// A frame is in hand; extraction begins.
  void start_frame() {
    times_ = {};
    frame_start_ns_ = monotonic_ns();
    watch_ = Stopwatch();
    current_ = &times_.extract_ns;
  }
  void begin(TrackingStage stage) {
    *current_ += watch_.lap_ns();
    current_ = stage == TrackingStage::kMatch      ? &times_.match_ns
               : stage == TrackingStage::kOptimise ? &times_.optimise_ns
                                                   : &rest_ns_;
  }
  /// The pose has been handed to the bus.
  const FrameTimes& end_frame(std::int64_t published_ns) {
    *current_ += watch_.lap_ns();
    current_ = &rest_ns_;
    const std::int64_t now_ns = monotonic_ns();
    times_.total_ns = now_ns - frame_start_ns_;
    times_.latency_ns = now_ns - published_ns;
    return times_;
  }

 private:
  FrameTimes times_;
  std::int64_t rest_ns_ = 0;
  std::int64_t* current_ = &rest_ns_;
  std::int64_t frame_start_ns_ = 0;
  Stopwatch watch_;
};

}  // namespace tsg
