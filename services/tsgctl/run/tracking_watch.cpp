#include "services/tsgctl/run/tracking_watch.hpp"

#include <algorithm>

#include "common/core/time.hpp"

namespace tsg {
namespace {

std::string state_text(const tsg_TrackingStatus& status) {
  switch (status.state) {
    case tsg_TRACKING_INITIALISING:
      return "initialising";
    case tsg_TRACKING_OK:
      return "tracking";
    case tsg_TRACKING_RELOCALISING:
      return "relocalising";
    default:
      return "lost";
  }
}

TrackingSample to_sample(const tsg_TrackingStatus& status) {
  return {.seq = status.header.seq,
          .tracked = status.state == tsg_TRACKING_OK,
          .mask_age_frames = status.mask_age_frames,
          .frames_dropped = status.frames_dropped,
          .extract_ns = status.extract_ns,
          .match_ns = status.match_ns,
          .optimise_ns = status.optimise_ns,
          .total_ns = status.total_ns,
          .latency_ns = status.latency_ns};
}

}  // namespace

bool TrackingWatch::sees_other_system(std::chrono::milliseconds timeout,
                                      const std::stop_token& stop) {
  return statuses_.wait_for_publishers(1, timeout, stop);
}

bool TrackingWatch::wait(std::chrono::milliseconds timeout, const std::stop_token& stop) {
  auto status = statuses_.take(stop, timeout);
  const bool any = status.has_value();
  while (status) {
    add(**status);
    status = statuses_.try_take();
  }
  return any;
}

void TrackingWatch::add(const tsg_TrackingStatus& status) {
  const std::int64_t now = monotonic_ns();
  if (log_.size() == 0) first_ns_ = now;
  last_ns_ = now;
  log_.add(to_sample(status));
  frames_passed_ = std::max(frames_passed_, status.header.seq + 1);
  state_ = state_text(status);
}

double TrackingWatch::elapsed_s() const { return to_seconds(last_ns_ - first_ns_); }

}  // namespace tsg
