#include "services/map_server/map_report.hpp"

#include <nlohmann/json.hpp>

namespace tsg {

nlohmann::json to_json(const MapSummary& summary,
                       const KeyframeCounts& counts,
                       const Summary& integration_ms) {
  nlohmann::json objects = nlohmann::json::array();
  for (const ObjectClass& object : summary.objects) {
    objects.push_back({{"class", object.name},
                       {"count", object.count},
                       {"max_in_view", object.max_in_view},
                       {"leaves", object.leaves}});
  }
  return {{"keyframes", summary.keyframes},
          {"keyframes_without_labels", summary.keyframes_without_labels},
          {"keyframes_rejected", counts.rejected},
          {"keyframes_missed", counts.missed},
          {"last_rejection", counts.last_rejection},
          {"points_raw", summary.points_raw},
          {"points", summary.points},
          {"leaves", summary.leaves},
          {"leaves_free", summary.leaves_free},
          {"objects", objects},
          {"integration_p50_ms", integration_ms.median},
          {"integration_p99_ms", integration_ms.p99}};
}

nlohmann::json to_json(const MapFiles& files) {
  return {{"points", files.points},
          {"bytes_ot", files.bytes_ot},
          {"bytes_bt", files.bytes_bt},
          {"bytes_ply", files.bytes_ply}};
}

}  // namespace tsg
