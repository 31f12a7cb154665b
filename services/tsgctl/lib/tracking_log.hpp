#pragma once

#include <cstdint>
#include <vector>

namespace tsg {

/// What slam said of one frame.
struct TrackingSample {
  std::uint64_t seq = 0;
  bool tracked = false;
  int mask_age_frames = -1;          ///< -1 without a mask
  std::uint64_t frames_dropped = 0;  ///< that slam never saw, since the start
  std::int64_t extract_ns = 0;
  std::int64_t match_ns = 0;
  std::int64_t optimise_ns = 0;
  std::int64_t total_ns = 0;
  std::int64_t latency_ns = 0;  ///< frame published to pose published
};

/// Typical and worst value; zero where nothing was measured.
struct Percentiles {
  double p50 = 0.0;
  double p99 = 0.0;
};

/// A run as tracking saw it.
struct TrackingTotals {
  std::uint64_t answered = 0;
  std::uint64_t tracked = 0;
  std::uint64_t lost = 0;
  std::uint64_t dropped = 0;
  std::uint64_t with_mask = 0;  ///< answered frames for which slam had some mask
  Percentiles mask_age_frames;  ///< of those
  Percentiles extract_ms;
  Percentiles match_ms;
  Percentiles optimise_ms;
  Percentiles total_ms;
  Percentiles latency_ms;
};

/// Median and 99th percentile of `values`.
[[nodiscard]] Percentiles percentiles_of(std::vector<double> values);

/// Collects what slam says of each frame of a run.
class TrackingLog {
 public:
  void add(const TrackingSample& sample) { samples_.push_back(sample); }
  [[nodiscard]] std::uint64_t size() const { return samples_.size(); }
  [[nodiscard]] TrackingTotals totals() const;

 private:
  [[nodiscard]] Percentiles milliseconds_of(std::int64_t TrackingSample::*time) const;

  std::vector<TrackingSample> samples_;
};

}  // namespace tsg
