#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "services/tsgctl/lib/progress_line.hpp"
#include "services/tsgctl/lib/tracking_log.hpp"

namespace tsg {

/// Follows a run by what slam says of each frame. Not thread-safe: one owner.
class TrackingWatch {
 public:
  explicit TrackingWatch(Bus& bus) : statuses_(bus) {}

  /// Whether somebody publishes tracking status already, i.e. another system runs on this bus.
  bool sees_other_system(std::chrono::milliseconds timeout, const std::stop_token& stop);

  /// Takes in what has come, waiting for the first up to `timeout`; false where nothing came.
  bool wait(std::chrono::milliseconds timeout, const std::stop_token& stop);

  [[nodiscard]] const TrackingLog& log() const { return log_; }
  /// Frames up to the last answered one, whether they were answered or dropped.
  [[nodiscard]] std::uint64_t frames_passed() const { return frames_passed_; }
  [[nodiscard]] const std::string& state() const { return state_; }
  /// From the first answer to the last.
  [[nodiscard]] double elapsed_s() const;

 private:
  void add(const tsg_TrackingStatus& status);

  Subscriber<topics::TrackingStatus> statuses_;
  TrackingLog log_;
  std::string state_ = "waiting for the first frame";
  std::uint64_t frames_passed_ = 0;
  std::int64_t first_ns_ = 0;
  std::int64_t last_ns_ = 0;
};

}  // namespace tsg
