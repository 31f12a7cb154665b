#include "services/slam/map_jobs.hpp"

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "common/core/time.hpp"
#include "services/slam/lib/saved_map.hpp"

namespace tsg {
namespace {

template <typename T>
bool is_ready(const std::future<T>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

Expected<std::string> write(const std::filesystem::path& file,
                            const MapContents& contents,
                            const FeatureConfig& features) {
  Stopwatch watch;
  return save_map(file, contents, features, utc_ns()).map([&](const MapFileInfo& info) {
    std::error_code ignored;  // told by the size then; a device has none
    const std::uintmax_t bytes = std::filesystem::file_size(file, ignored);
    return nlohmann::json{{"file", file.string()},
                          {"keyframes", info.keyframes()},
                          {"points", info.points()},
                          {"bytes", ignored ? 0 : bytes},
                          {"seconds", to_seconds(watch.lap_ns())}}
        .dump();
  });
}

}  // namespace

Expected<LoadedMap> read_map(const std::filesystem::path& file, const SlamConfig& config) {
  return load_map(file, config.features).map([&](MapContents&& contents) {
    const CameraModel camera = contents.camera;
    const KeyframeId newest = contents.newest;
    const std::size_t keyframes = contents.keyframes.size();
    const std::size_t points = contents.points.size();
    return LoadedMap{file,      camera, newest,
                     keyframes, points, LocalMapper(config, std::move(contents))};
  });
}

CommandServer::Pending begin_to_write(const std::filesystem::path& file,
                                      std::future<MapContents> contents,
                                      const FeatureConfig& features) {
  // Shared, as a std::function must be copyable.
  auto written = std::make_shared<std::future<Expected<std::string>>>(std::async(
      std::launch::async,
      [file, features](std::future<MapContents> copy) { return write(file, copy.get(), features); },
      std::move(contents)));
  return [written]() -> std::optional<Expected<std::string>> {
    if (!is_ready(*written)) return std::nullopt;
    return written->get();
  };
}

CommandServer::Pending begin_to_read(const std::filesystem::path& file,
                                     const SlamConfig& config,
                                     std::function<Expected<std::string>(LoadedMap&&)> use) {
  auto map = std::make_shared<std::future<Expected<LoadedMap>>>(
      std::async(std::launch::async, [file, config] { return read_map(file, config); }));
  return [map, use = std::move(use)]() -> std::optional<Expected<std::string>> {
    if (!is_ready(*map)) return std::nullopt;
    return map->get().and_then([&](LoadedMap&& loaded) { return use(std::move(loaded)); });
  };
}

}  // namespace tsg
