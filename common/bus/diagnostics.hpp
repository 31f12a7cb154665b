#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"

namespace tsg {

/// As diagnostic_msgs/DiagnosticStatus numbers them.
enum class DiagnosticLevel : std::uint8_t { kOk = 0, kWarn = 1, kError = 2, kStale = 3 };

/// What a service says of itself: a sentence, and figures such as {"rate_hz", "29.9"}.
struct Diagnostic {
  DiagnosticLevel level = DiagnosticLevel::kOk;
  std::string message;
  std::vector<std::pair<std::string, std::string>> values;
};

/// A Diagnostic as received.
struct NamedDiagnostic {
  std::string name;           ///< of the service
  std::int64_t stamp_ns = 0;  ///< UTC
  Diagnostic diagnostic;
};

/// Publishes a service's state on rt/diagnostics once a second. One owner:
///   if (diagnostics.is_due()) diagnostics.publish({...});
class DiagnosticsPublisher {
 public:
  DiagnosticsPublisher(Bus& bus, std::string service);

  /// True at first, then a second after the last publish().
  [[nodiscard]] bool is_due() const;
  Expected<void> publish(const Diagnostic& diagnostic);

 private:
  using Clock = std::chrono::steady_clock;

  std::string service_;
  std::string host_name_;
  Clock::time_point next_;
  Publisher<topics::Diagnostics> publisher_;
};

/// The content of a message of rt/diagnostics, ours or anybody's.
[[nodiscard]] std::vector<NamedDiagnostic> to_diagnostics(
    const topics::Diagnostics::Message& message);

}  // namespace tsg
