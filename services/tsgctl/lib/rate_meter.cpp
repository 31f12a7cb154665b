#include "services/tsgctl/lib/rate_meter.hpp"

#include <vector>

#include "common/core/statistics.hpp"
#include "common/core/time.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

double rate_of_period(double period_ms) { return period_ms > 0.0 ? 1000.0 / period_ms : 0.0; }

std::vector<double> periods_ms(const std::deque<Arrival>& arrivals) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < arrivals.size(); ++i) {
    periods.push_back(to_milliseconds(arrivals[i].received_ns - arrivals[i - 1].received_ns));
  }
  return periods;
}

std::vector<double> latencies_ms(const std::deque<Arrival>& arrivals) {
  std::vector<double> latencies;
  for (const Arrival& arrival : arrivals) {
    if (!arrival.published_ns) continue;
    latencies.push_back(to_milliseconds(arrival.received_ns - *arrival.published_ns));
  }
  return latencies;
}

}  // namespace

void RateMeter::add(const Arrival& arrival) {
  arrivals_.push_back(arrival);
  if (arrivals_.size() > window_) arrivals_.pop_front();
  if (!arrival.seq) return;
  // A smaller number means that the publisher has started anew.
  if (last_seq_ && *arrival.seq > *last_seq_ + 1) missed_ += *arrival.seq - *last_seq_ - 1;
  last_seq_ = arrival.seq;
}

RateSummary RateMeter::summary() const {
  RateSummary result;
  result.samples = arrivals_.size();
  result.missed = missed_;
  std::vector<double> latencies = latencies_ms(arrivals_);
  if (!latencies.empty()) result.latency_ms = percentiles_of(std::move(latencies));
  if (arrivals_.size() < 2) return result;
  const Summary periods = summarise(periods_ms(arrivals_));
  result.rate_hz = rate_of_period(periods.mean);
  result.slowest_hz = rate_of_period(periods.max);
  result.fastest_hz = rate_of_period(periods.min);
  result.jitter_ms = periods.std_dev;
  return result;
}

std::string rate_text(const RateSummary& summary) {
  std::string text = fixed(summary.rate_hz, 2) + " Hz  min " + fixed(summary.slowest_hz, 1) +
                     "  max " + fixed(summary.fastest_hz, 1) + "  jitter " +
                     fixed(summary.jitter_ms, 1) + " ms";
  if (summary.latency_ms) {
    text += "  latency " + fixed(summary.latency_ms->p50, 2) + "/" +
            fixed(summary.latency_ms->p99, 2) + " ms (p50/p99)  missed " +
            std::to_string(summary.missed);
  }
  return text + "  over " + std::to_string(summary.samples) + " samples";
}

}  // namespace tsg
