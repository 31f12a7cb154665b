#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <string>

#include "common/bus/command.hpp"
#include "services/slam/lib/local_mapper.hpp"
#include "services/slam/lib/map_contents.hpp"

namespace tsg {

/// A map that was read from a file, ready to work with.
struct LoadedMap {
  std::filesystem::path file;
  CameraModel camera;
  KeyframeId newest = 0;
  std::size_t keyframes = 0;
  std::size_t points = 0;
  LocalMapper mapper;
};

/// Reads a map file and makes its map ready: about 3 ms a keyframe. Errors as load_map() has them.
[[nodiscard]] Expected<LoadedMap> read_map(const std::filesystem::path& file,
                                           const SlamConfig& config);

/// Writes a map beside the caller's thread. The answer:
/// {"file": F, "keyframes": N, "points": N, "bytes": N, "seconds": S}.
[[nodiscard]] CommandServer::Pending begin_to_write(const std::filesystem::path& file,
                                                    std::future<MapContents> contents,
                                                    const FeatureConfig& features);

/// Reads a map beside the caller's thread; `use` gets it on the thread that asks for the answer,
/// which it gives.
[[nodiscard]] CommandServer::Pending begin_to_read(
    const std::filesystem::path& file,
    const SlamConfig& config,
    std::function<Expected<std::string>(LoadedMap&&)> use);

}  // namespace tsg
