#include "services/segmentation/counters.hpp"

#include <nlohmann/json.hpp>

#include "common/core/time.hpp"

namespace tsg {

namespace {

nlohmann::json quantiles(const RecentValues& values) {
  const Summary summary = values.summary();
  return {{"p50", summary.median}, {"p99", summary.p99}};
}

}  // namespace

void RecentValues::add(double value) {
  if (values_.size() < kCapacity) {
    values_.push_back(value);
    return;
  }
  values_[next_] = value;
  next_ = (next_ + 1) % kCapacity;
}

void SegmentationCounters::add(const SegmentationResult& result) {
  ++frames;
  left_out += static_cast<std::uint64_t>(result.left_out);
  preprocess_ms.add(to_milliseconds(result.times.preprocess_ns));
  network_ms.add(to_milliseconds(result.times.network_ns));
  postprocess_ms.add(to_milliseconds(result.times.postprocess_ns));
  total_ms.add(to_milliseconds(result.times.total_ns()));
}

nlohmann::json SegmentationCounters::to_json() const {
  return {{"taken", taken},
          {"frames", frames},
          {"failed", failed},
          {"backlog", backlog()},
          {"left_out", left_out},
          {"preprocess_ms", quantiles(preprocess_ms)},
          {"network_ms", quantiles(network_ms)},
          {"postprocess_ms", quantiles(postprocess_ms)},
          {"inference_ms", quantiles(total_ms)},
          {"input_age_ms", quantiles(input_age_ms)},
          {"latency_ms", quantiles(latency_ms)}};
}

}  // namespace tsg
