#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/error.hpp"
#include "common/geometry/camera_model.hpp"

namespace tsg {

/// Maps of one format can be read by programs that know it or a newer one.
inline constexpr std::uint32_t kMapFormatVersion = 1;

/// How corners were described: maps can only be compared with frames that are described alike.
struct MapFeatureSettings {
  std::uint32_t levels = 0;   ///< of the image pyramid
  double scale_factor = 0.0;  ///< between two of them
  std::uint32_t pattern = 0;  ///< identifies the comparisons that make up a descriptor

  bool operator==(const MapFeatureSettings&) const = default;
};

/// What one part of a map holds. Each part has a world of its own.
struct MapPartInfo {
  std::uint32_t part = 0;
  std::uint64_t keyframes = 0;
  std::uint64_t points = 0;
  /// Along the world's axes, without the outermost hundredth of its points on each side.
  Eigen::Vector3d extent_m = Eigen::Vector3d::Zero();

  bool operator==(const MapPartInfo&) const = default;
};

/// What a user wants to know of a map file, and what decides whether it can be used.
struct MapFileInfo {
  std::int64_t created_ns = 0;  ///< since 1970, UTC
  CameraModel camera;
  MapFeatureSettings features;
  std::vector<MapPartInfo> parts;

  [[nodiscard]] std::uint64_t keyframes() const;
  [[nodiscard]] std::uint64_t points() const;
  bool operator==(const MapFileInfo&) const = default;
};

/// A map file whose checksum holds.
struct MapFile {
  std::uint32_t version = 0;
  MapFileInfo info;
  std::string bytes;          ///< of the whole file
  std::size_t map_begin = 0;  ///< where the map begins in `bytes`

  /// In the encoding of slam.
  [[nodiscard]] std::string_view map() const { return std::string_view(bytes).substr(map_begin); }
};

/// Writes a map file, complete or not at all (write_file_atomically()).
[[nodiscard]] Expected<void> write_map_file(const std::filesystem::path& path,
                                            const MapFileInfo& info,
                                            std::string_view map);

/// Reads a map file and checks that nothing of it has changed since it was written. kMissingInput
/// where there is none that can be read; kBadData where it is damaged, of another kind or newer
/// than this program.
[[nodiscard]] Expected<MapFile> read_map_file(const std::filesystem::path& path);

}  // namespace tsg
