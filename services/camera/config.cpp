#include "services/camera/config.hpp"

namespace tsg {

std::vector<std::string> CameraConfig::problems() const {
  std::vector<std::string> found;
  if (source != "replay") found.emplace_back("source must be replay");
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
  reader.read("wait_for_subscribers", config.wait_for_subscribers);
  reader.read("subscriber_timeout_s", config.subscriber_timeout_s);
  reader.read("lockstep_timeout_s", config.lockstep_timeout_s);
  reader.read("read_ahead_frames", config.read_ahead_frames);
  reader.read("drain_s", config.drain_s);
  reader.finish(config.problems());
  return config;
}

}  // namespace tsg
