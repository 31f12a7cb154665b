#pragma once

#include <string>
#include <vector>

#include "common/app/config_file.hpp"
#include "services/map_server/lib/semantic_map.hpp"

namespace tsg {

struct MapServerConfig {
  MapConfig map;
  /// Keyframes that may wait for integration, 1.8 MB each at VGA. When all are taken, keyframes
  /// wait in the bus, and are lost there (counted) when its own queue is full.
  int queue_keyframes = 16;

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// Reads section "map_server"; throws FatalError (kConfig) listing all that is wrong with it.
[[nodiscard]] MapServerConfig load_map_server_config(const ConfigFile& file);

}  // namespace tsg
