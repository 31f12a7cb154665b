#include "services/camera/open_source.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include "common/app/shipped_files.hpp"
#include "common/core/time.hpp"
#include "common/scene_file/scene_file.hpp"
#include "common/scene_file/scene_library.hpp"
#include "services/camera/lib/simulation_source.hpp"

namespace tsg {
namespace {

using simulation::SceneDescription;

SceneDescription scene_of(const SimulationConfig& config) {
  std::vector<std::filesystem::path> folders;
  for (const std::filesystem::path& folder : config_folders()) folders.push_back(folder / "scenes");
  const auto file = value_or_throw(SceneLibrary(folders).find(config.scene));
  SceneDescription scene = value_or_throw(load_scene(file));
  simulation::SensorDescription& sensor = scene.sensor;
  if (config.seed != 0) scene.seed = static_cast<std::uint64_t>(config.seed);
  if (config.width != 0) sensor.camera = sensor.camera.resized(config.width, config.height);
  if (config.rate_hz != 0.0) sensor.rate_hz = config.rate_hz;
  return scene;
}

}  // namespace

std::unique_ptr<FrameSource> open_source(const CameraConfig& config) {
  if (config.source == "replay") return value_or_throw(ReplaySource::open(config.replay));
  auto simulator = value_or_throw(simulation::Simulator::build(scene_of(config.simulation)));
  return std::make_unique<SimulationSource>(
      std::move(simulator), utc_ns(),
      config.simulation.endless ? SceneEnd::kGoOn : SceneEnd::kStop);
}

}  // namespace tsg
