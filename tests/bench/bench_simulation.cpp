// Rendering of simulated rooms at VGA size, on all cores: wall time. Release preset only.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "common/core/error.hpp"
#include "common/scene_file/scene_file.hpp"
#include "common/simulation/simulator.hpp"

namespace tsg {
namespace {

simulation::SceneDescription scene_called(const char* name) {
  const std::filesystem::path scenes = std::filesystem::path(TSG_SOURCE_DIR) / "config/scenes";
  return value_or_throw(load_scene(scenes / (std::string(name) + ".yaml")));
}

/// Geometry, textures and baked light.
void build_scene(benchmark::State& state, const char* name) {
  const simulation::SceneDescription scene = scene_called(name);
  for (auto _ : state) {
    benchmark::DoNotOptimize(value_or_throw(simulation::Simulator::build(scene)));
  }
}

/// Frames spread over the whole scene; items/s are frames/s.
void render_frames(benchmark::State& state, const char* name) {
  simulation::Simulator simulator =
      value_or_throw(simulation::Simulator::build(scene_called(name)));
  int frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulator.render(frame));
    frame = (frame + 37) % simulator.frame_count();
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK_CAPTURE(build_scene, office_walking_xyz, "office_walking_xyz")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(build_scene, corridor_loop, "corridor_loop")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(render_frames, office_walking_xyz, "office_walking_xyz")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(render_frames, crowd, "crowd")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(render_frames, corridor_loop, "corridor_loop")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace tsg

BENCHMARK_MAIN();
