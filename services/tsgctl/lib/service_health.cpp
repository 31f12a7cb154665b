#include "services/tsgctl/lib/service_health.hpp"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>

#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

const char* to_string(HealthState state) {
  switch (state) {
    case HealthState::kOk:
      return "ok";
    case HealthState::kWarn:
      return "warn";
    case HealthState::kError:
      return "ERROR";
    case HealthState::kSilent:
      break;
  }
  return "silent";
}

/// The first of these figures that the service has, "-" where it has none.
std::string figure(const ServiceHealth& health, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const auto found = health.values.find(name); found != health.values.end()) {
      return found->second;
    }
  }
  return "-";
}

/// A number with one digit after the point; what is no number stays as it is.
std::string rounded(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end == text.c_str() || *end != '\0' ? text : fixed(number, 1);
}

std::string latency(const ServiceHealth& health) {
  const std::string p50 = figure(health, {"latency_p50_ms"});
  if (p50 == "-") return p50;
  return rounded(p50) + "/" + rounded(figure(health, {"latency_p99_ms"}));
}

}  // namespace

const std::vector<std::string>& service_names() {
  static const std::vector<std::string> kNames{"camera", "segmentation", "slam", "map_server"};
  return kNames;
}

std::string health_text(const std::vector<ServiceHealth>& services) {
  std::vector<std::vector<std::string>> rows{
      {"SERVICE", "STATE", "RATE Hz", "DROPPED", "LATENCY ms p50/p99", "MESSAGE"}};
  for (const ServiceHealth& health : services) {
    rows.push_back({health.service, to_string(health.state), rounded(figure(health, {"rate_hz"})),
                    figure(health, {"frames_dropped", "passed_over", "dropped", "missed"}),
                    latency(health), health.message});
  }
  return format_table(rows);
}

nlohmann::json health_json(const std::vector<ServiceHealth>& services) {
  nlohmann::json json = nlohmann::json::object();
  for (const ServiceHealth& health : services) {
    json[health.service] = {
        {"state", to_string(health.state)}, {"message", health.message}, {"values", health.values}};
  }
  return json;
}

std::string unhealthy_names(const std::vector<ServiceHealth>& services) {
  std::string names;
  for (const ServiceHealth& health : services) {
    if (health.state == HealthState::kOk || health.state == HealthState::kWarn) continue;
    names += (names.empty() ? "" : ", ") + health.service;
  }
  return names;
}

bool all_silent(const std::vector<ServiceHealth>& services) {
  return std::all_of(services.begin(), services.end(), [](const ServiceHealth& health) {
    return health.state == HealthState::kSilent;
  });
}

}  // namespace tsg
