#pragma once

#include <nlohmann/json_fwd.hpp>

#include "services/map_server/lib/semantic_map.hpp"
#include "services/map_server/progress.hpp"

namespace tsg {

/// For the reply of `report` (README.md lists the keys).
[[nodiscard]] nlohmann::json to_json(const MapSummary& summary,
                                     const KeyframeCounts& counts,
                                     const Summary& integration_ms);
/// What the reply of `save_map` says of the files.
[[nodiscard]] nlohmann::json to_json(const MapFiles& files);

}  // namespace tsg
