#include "services/camera/config.hpp"

namespace tsg {
namespace {

void check(const SimulationConfig& config, std::vector<std::string>& found) {
  if (config.scene.empty()) {
    found.emplace_back("simulation.scene is not set; tsgctl simulate --list tells of scenes");
  }
  if (config.seed < 0) found.emplace_back("simulation.seed must be >= 0");
  const bool scene_decides = config.width == 0 && config.height == 0;
  const bool fits =
      config.width >= 16 && config.width <= 1280 && config.height >= 16 && config.height <= 720;
  if (!scene_decides && !fits) {
    found.emplace_back("simulation.width and .height must be 16 to 1280 and 16 to 720, or both 0");
  }
  if (config.rate_hz != 0.0 && !(config.rate_hz >= 1.0 && config.rate_hz <= 120.0)) {
    found.emplace_back("simulation.rate_hz must be 1 to 120, or 0");
  }
}

}  // namespace

std::vector<std::string> CameraConfig::problems() const {
  std::vector<std::string> found;
  if (source != "replay" && source != "simulation") {
    found.emplace_back("source must be replay or simulation");
  }
  if (source == "simulation") check(simulation, found);
  if (pace != "realtime" && pace != "lockstep") {
    found.emplace_back("pace must be realtime or lockstep");
  }
  if (wait_for_subscribers < 0) found.emplace_back("wait_for_subscribers must be >= 0");
  if (!(subscriber_timeout_s > 0.0)) found.emplace_back("subscriber_timeout_s must be > 0");
  if (!(lockstep_timeout_s > 0.0)) found.emplace_back("lockstep_timeout_s must be > 0");
  if (read_ahead_frames < 1 || read_ahead_frames > 7) {
    found.emplace_back("read_ahead_frames must be 1 to 7");
  }
  if (!(drain_s >= 0.0 && drain_s <= 60.0)) found.emplace_back("drain_s must be 0 to 60");
  return found;
}

CameraConfig load_camera_config(const ConfigFile& file) {
  CameraConfig config;
  ConfigReader reader(file, "camera");
  reader.read("source", config.source);
  reader.read("pace", config.pace);
  reader.read("replay.folder", config.replay.folder);
  reader.read("replay.loop", config.replay.loop);
  reader.read("simulation.scene", config.simulation.scene);
  reader.read("simulation.seed", config.simulation.seed);
  reader.read("simulation.width", config.simulation.width);
  reader.read("simulation.height", config.simulation.height);
  reader.read("simulation.rate_hz", config.simulation.rate_hz);
  reader.read("simulation.endless", config.simulation.endless);
  reader.read("wait_for_subscribers", config.wait_for_subscribers);
  reader.read("subscriber_timeout_s", config.subscriber_timeout_s);
  reader.read("lockstep_timeout_s", config.lockstep_timeout_s);
  reader.read("read_ahead_frames", config.read_ahead_frames);
  reader.read("drain_s", config.drain_s);
  reader.finish(config.problems());
  return config;
}

}  // namespace tsg
