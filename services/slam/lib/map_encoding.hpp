#pragma once

#include <string>
#include <string_view>

#include "common/core/error.hpp"
#include "common/map_file/map_file.hpp"
#include "services/slam/lib/map_contents.hpp"

namespace tsg {

/// The map as bytes: docs/decisions/0007-map-file.md has the layout. The camera is not part of it.
[[nodiscard]] std::string encode_map(const MapContents& contents);

/// The map again, bit for bit. Whatever the bytes are, the outcome is a map that keeps every
/// promise of MapContents, or kBadData with what is wrong.
[[nodiscard]] Expected<MapContents> decode_map(std::string_view bytes,
                                               const CameraModel& camera,
                                               const MapFeatureSettings& features);

/// What makes a map unusable although each of its numbers could be right; empty where it is sound.
[[nodiscard]] std::string find_inconsistency(const MapContents& contents);

}  // namespace tsg
