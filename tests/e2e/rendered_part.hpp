#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/scene_file/scene_file.hpp"
#include "services/tsgctl/simulate/sequence_writer.hpp"

namespace tsg::test {

/// A part of a shipped scene, rendered small unless told otherwise, as rendering takes most of a
/// test's time.
struct ScenePart {
  std::string name;
  double from_s = 0.0;
  double to_s = 0.0;
  double rate_hz = 30.0;
  int width = 320;
  int height = 240;
};

/// Writes the part as a sequence with true masks into `folder`. Throws FatalError.
inline void render_part(const ScenePart& part, const std::filesystem::path& folder) {
  auto scene = value_or_throw(load_scene(TSG_SOURCE_DIR "/config/scenes/" + part.name + ".yaml"));
  scene.sensor.camera = scene.sensor.camera.resized(part.width, part.height);
  scene.sensor.rate_hz = part.rate_hz;
  auto simulator = value_or_throw(simulation::Simulator::build(scene));
  auto writer = value_or_throw(SequenceWriter::open(folder, scene.sensor, simulator.instances()));
  const int until = static_cast<int>(part.to_s * part.rate_hz);
  std::vector<int> frames;
  for (int frame = static_cast<int>(part.from_s * part.rate_hz); frame < until; ++frame) {
    throw_on_error(writer.add(simulator.render(frame)));
    frames.push_back(frame);
  }
  throw_on_error(write_truth_of_scene(simulator, frames, folder));
  throw_on_error(writer.finish());
}

}  // namespace tsg::test
