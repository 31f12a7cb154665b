#include "common/app/sample_window_json.hpp"

#include <nlohmann/json.hpp>

namespace tsg {

nlohmann::json to_json(const SampleWindow& window) {
  const Summary summary = window.summary();
  return {{"count", summary.count},
          {"p50", summary.median},
          {"p99", summary.p99},
          {"max", summary.max}};
}

}  // namespace tsg
