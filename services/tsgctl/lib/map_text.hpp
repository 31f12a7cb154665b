#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "common/map_file/map_file.hpp"

namespace tsg {

/// What `tsgctl map info` tells of a map file.
struct MapFileReport {
  std::string path;
  std::uint64_t bytes = 0;
  std::uint32_t version = 0;  ///< of the format
  MapFileInfo info;
};

[[nodiscard]] std::string to_text(const MapFileReport& report);
[[nodiscard]] nlohmann::json to_json(const MapFileReport& report);

}  // namespace tsg
