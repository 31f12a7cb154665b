#pragma once

#include <cstdint>
#include <string>

#include "common/app/log.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/diagnostics.hpp"
#include "services/segmentation/counters.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"

namespace tsg {

/// As diagnostics have numbers: "12.3".
[[nodiscard]] std::string with_one_decimal(double value);

/// Tells once a second what the service has done and whether all is as it should be: on
/// rt/diagnostics, and in the log when that changes. One owner.
class StatusPublisher {
 public:
  /// `service` is what the diagnostics are called.
  StatusPublisher(Bus& bus, const Log& log, const std::string& service);

  [[nodiscard]] bool is_due() const { return diagnostics_.is_due(); }

  /// `provider` is whose masks they are; `passed_over` counts frames that nobody looked at.
  void publish(const SegmentationCounters& counters,
               const std::string& provider,
               std::uint64_t passed_over,
               const ProviderState& state);

 private:
  void log_change(const std::string& problem);

  Log log_;
  DiagnosticsPublisher diagnostics_;
  std::string problem_;
  // As of the last diagnostics.
  std::int64_t reported_at_ns_;
  std::uint64_t reported_frames_ = 0;
  std::uint64_t reported_failed_ = 0;
};

}  // namespace tsg
