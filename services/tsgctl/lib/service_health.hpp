#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tsg {

/// The four services, in the order of the data flow.
[[nodiscard]] const std::vector<std::string>& service_names();

enum class HealthState { kOk, kWarn, kError, kSilent };

/// What a service says of itself; kSilent where it says nothing.
struct ServiceHealth {
  std::string service;
  HealthState state = HealthState::kSilent;
  std::string message;
  std::map<std::string, std::string> values;  ///< figures by name, as the service publishes them
};

/// A line for each service: state, rate, drops, latency, message.
[[nodiscard]] std::string health_text(const std::vector<ServiceHealth>& services);
[[nodiscard]] nlohmann::json health_json(const std::vector<ServiceHealth>& services);

/// Names of those that are silent or report an error, "camera, slam"; empty where all are well.
[[nodiscard]] std::string unhealthy_names(const std::vector<ServiceHealth>& services);
[[nodiscard]] bool all_silent(const std::vector<ServiceHealth>& services);

}  // namespace tsg
