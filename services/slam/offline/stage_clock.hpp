#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "common/core/time.hpp"
#include "services/slam/lib/tracking_stage.hpp"

namespace tsg {

/// What one frame took by stage, in milliseconds of the clock that was given.
struct FrameCost {
  double extract_ms = 0.0;
  double match_ms = 0.0;
  double optimise_ms = 0.0;
  double decide_ms = 0.0;  ///< and all else that tracking does
  double mapping_ms =
      0.0;  ///< all that the map's owner does after the frame, its snapshot included

  [[nodiscard]] double tracking_ms() const {
    return extract_ms + match_ms + optimise_ms + decide_ms;
  }
};

/// Shares out the time of a frame among its stages, by a clock of the caller's.
class StageClock {
 public:
  /// `now_ns` may be empty: then nothing is measured, and all costs are zero.
  explicit StageClock(std::function<std::int64_t()> now_ns) : now_ns_(std::move(now_ns)) {}

  void start_frame() {
    cost_ = {};
    lap_start_ns_ = now();
    stage_ms_ = &cost_.extract_ms;
  }
  /// Features are there, tracking begins.
  void start_tracking() { switch_to(cost_.decide_ms); }
  void begin(TrackingStage stage) {
    switch_to(stage == TrackingStage::kMatch      ? cost_.match_ms
              : stage == TrackingStage::kOptimise ? cost_.optimise_ms
                                                  : cost_.decide_ms);
  }
  void start_mapping() { switch_to(cost_.mapping_ms); }
  const FrameCost& end_frame() {
    switch_to(cost_.mapping_ms);
    return cost_;
  }

 private:
  [[nodiscard]] std::int64_t now() const { return now_ns_ ? now_ns_() : 0; }

  void switch_to(double& stage_ms) {
    const std::int64_t now_ns = now();
    *stage_ms_ += to_milliseconds(now_ns - std::exchange(lap_start_ns_, now_ns));
    stage_ms_ = &stage_ms;
  }

  std::function<std::int64_t()> now_ns_;
  FrameCost cost_;
  double* stage_ms_ = &cost_.extract_ms;
  std::int64_t lap_start_ns_ = 0;
};

}  // namespace tsg
