#pragma once

#include <cstdint>
#include <filesystem>

#include "common/core/error.hpp"
#include "common/map_file/map_file.hpp"
#include "services/slam/lib/map_contents.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Writes a map into a file (common/map_file), complete or not at all; what the file tells of it.
/// `created_ns`: the present, since 1970. kCannotWrite names the file, the reason and the fix.
[[nodiscard]] Expected<MapFileInfo> save_map(const std::filesystem::path& path,
                                             const MapContents& contents,
                                             const FeatureConfig& features,
                                             std::int64_t created_ns);

/// Reads it again. Beyond the errors of read_map_file(): kConfig where its corners were described
/// otherwise than `features` says, so that no frame would look like the map.
[[nodiscard]] Expected<MapContents> load_map(const std::filesystem::path& path,
                                             const FeatureConfig& features);

}  // namespace tsg
