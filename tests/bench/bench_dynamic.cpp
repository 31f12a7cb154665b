// Feature removal by epipolar lines at real size: two frames of 1000 features. Release preset only.

#include <benchmark/benchmark.h>

#include "services/slam/lib/dynamic/epipolar_coupling.hpp"
#include "services/slam/lib/dynamic/synthetic_pairs.hpp"

namespace tsg {
namespace {

constexpr double kPixelNoise = 0.3;

/// A room, and a chair with the rest of the features that is pushed.
synthetic::TwoFrames frames_with(std::size_t moving, const SE3& T_world_current) {
  constexpr std::size_t kFeatures = 1000;
  synthetic::Body chair = synthetic::box_at({0.0, 0.0, 2.0}, moving, 1);
  chair.motion = {-0.01, 0.03, 0.0};
  chair.prior = FeatureVerdict::kPotentiallyDynamic;
  return synthetic::observe({synthetic::room(kFeatures - moving, 2), chair}, T_world_current,
                            kPixelNoise);
}

void judge(benchmark::State& state, DynamicMethod method, const SE3& T_world_current) {
  const auto frames = frames_with(static_cast<std::size_t>(state.range(0)), T_world_current);
  int matches = 0;
  for (auto _ : state) {
    const CouplingVerdicts verdicts =
        judge_by_epipolar_lines(frames.reference, frames.current, method, CouplingConfig{});
    benchmark::DoNotOptimize(matches = verdicts.matches);
  }
  state.counters["matches"] = matches;
  state.SetItemsProcessed(state.iterations());
}

const SE3 kMoved = synthetic::pose_at(0.03, 0.015, 0.01, 0.005);

BENCHMARK_CAPTURE(judge, tsg, DynamicMethod::kTsg, kMoved)
    ->ArgName("moving")
    ->Arg(0)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judge, epipolar, DynamicMethod::kEpipolar, kMoved)
    ->ArgName("moving")
    ->Arg(0)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judge, tsg_standing_camera, DynamicMethod::kTsg, SE3())
    ->ArgName("moving")
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tsg

BENCHMARK_MAIN();
