#include "services/tsgctl/lib/tracking_log.hpp"

#include <algorithm>

#include "common/core/statistics.hpp"
#include "common/core/time.hpp"

namespace tsg {

Percentiles percentiles_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.5), quantile(values, 0.99)};
}

Percentiles TrackingLog::milliseconds_of(std::int64_t TrackingSample::*time) const {
  std::vector<double> values;
  values.reserve(samples_.size());
  for (const TrackingSample& sample : samples_) values.push_back(to_milliseconds(sample.*time));
  return percentiles_of(std::move(values));
}

TrackingTotals TrackingLog::totals() const {
  TrackingTotals totals;
  totals.answered = samples_.size();
  std::vector<double> mask_ages;
  for (const TrackingSample& sample : samples_) {
    ++(sample.tracked ? totals.tracked : totals.lost);
    totals.dropped = std::max(totals.dropped, sample.frames_dropped);
    if (sample.mask_age_frames >= 0) mask_ages.push_back(sample.mask_age_frames);
  }
  totals.with_mask = mask_ages.size();
  totals.mask_age_frames = percentiles_of(std::move(mask_ages));
  totals.extract_ms = milliseconds_of(&TrackingSample::extract_ns);
  totals.match_ms = milliseconds_of(&TrackingSample::match_ns);
  totals.optimise_ms = milliseconds_of(&TrackingSample::optimise_ns);
  totals.total_ms = milliseconds_of(&TrackingSample::total_ns);
  totals.latency_ms = milliseconds_of(&TrackingSample::latency_ns);
  return totals;
}

}  // namespace tsg
