#include "common/bus/diagnostics.hpp"

#include <unistd.h>

#include <array>
#include <chrono>

#include "common/bus/convert.hpp"
#include "common/core/time.hpp"

namespace tsg {
namespace {

using Status = diagnostic_msgs_msg_dds__DiagnosticStatus_;
using KeyValue = diagnostic_msgs_msg_dds__KeyValue_;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "localhost";
}

}  // namespace

DiagnosticsPublisher::DiagnosticsPublisher(Bus& bus, std::string service)
    : service_(std::move(service)), host_name_(host_name()), next_(Clock::now()), publisher_(bus) {}

bool DiagnosticsPublisher::is_due() const { return Clock::now() >= next_; }

Expected<void> DiagnosticsPublisher::publish(const Diagnostic& diagnostic) {
  next_ = Clock::now() + std::chrono::seconds(1);
  std::vector<KeyValue> values;
  for (const auto& [key, value] : diagnostic.values) {
    values.push_back({.key = lend(key), .value = lend(value)});
  }
  std::vector<Status> statuses(1);
  Status& status = statuses.front();
  status.level = static_cast<std::uint8_t>(diagnostic.level);
  status.name = lend(service_);
  status.message = lend(diagnostic.message);
  status.hardware_id = lend(host_name_);
  lend(values, status.values);

  const std::string no_frame;
  topics::Diagnostics::Message message{};
  message.header.stamp = to_ros_time(utc_ns());
  message.header.frame_id = lend(no_frame);
  lend(statuses, message.status);
  return publisher_.publish(message);
}

std::vector<NamedDiagnostic> to_diagnostics(const topics::Diagnostics::Message& message) {
  std::vector<NamedDiagnostic> all;
  for (const Status& status : elements(message.status)) {
    NamedDiagnostic& named = all.emplace_back();
    named.name = status.name;
    named.stamp_ns = to_ns(message.header.stamp);
    named.diagnostic.level = static_cast<DiagnosticLevel>(status.level);
    named.diagnostic.message = status.message;
    for (const KeyValue& value : elements(status.values)) {
      named.diagnostic.values.emplace_back(value.key, value.value);
    }
  }
  return all;
}

}  // namespace tsg
