// The stages of slam_core at real size: VGA, 1000 features, ten keyframes. Release preset only.

#include <benchmark/benchmark.h>

#include <memory>
#include <random>

#include "services/slam/lib/bundle_adjustment.hpp"
#include "services/slam/lib/dynamic/class_policy.hpp"
#include "services/slam/lib/feature_extractor.hpp"
#include "services/slam/lib/feature_matcher.hpp"
#include "services/slam/lib/frame_search.hpp"
#include "services/slam/lib/local_mapper.hpp"
#include "services/slam/lib/pose_optimizer.hpp"
#include "services/slam/lib/synthetic_scene.hpp"
#include "services/slam/lib/tracker.hpp"

namespace tsg {
namespace {

constexpr int kPathFrames = 40;

SE3 on_path(int i) { return synthetic::pose_at(0.02 * i, 0.005 * i, 0.005 * i, 0.004 * i); }

const synthetic::Scene& room() {
  static const synthetic::Scene kRoom = synthetic::Scene::room();
  return kRoom;
}

const ObservationModel& model() {
  static const ObservationModel kModel(synthetic::camera(), SlamConfig{});
  return kModel;
}

void extraction(benchmark::State& state) {
  FeatureExtractor extractor(FeatureConfig{}, synthetic::camera());
  const RgbdFrame frame = room().render(0, SE3());
  for (auto _ : state) benchmark::DoNotOptimize(extractor.extract(frame, {}));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(extraction)->Unit(benchmark::kMillisecond);

void exact_mask(benchmark::State& state) {
  synthetic::Scene scene = room();
  scene.panel(1).label = 1;
  const RgbdFrame frame = scene.render(0, SE3());
  const InstanceSegmentation mask = scene.mask(frame, SE3(), {"person"});
  for (auto _ : state) benchmark::DoNotOptimize(exact_verdicts(mask, DynamicFilterConfig{}));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(exact_mask)->Unit(benchmark::kMillisecond);

/// A map from a run along the path, and the features of the frame after it.
struct MappedRoom {
  MappedRoom() : mapper(SlamConfig{}, synthetic::camera()) {
    Tracker tracker(SlamConfig{}, synthetic::camera());
    for (int i = 0; i < kPathFrames; ++i) {
      const RgbdFrame frame = room().render(static_cast<std::uint64_t>(i), on_path(i));
      TrackResult result = tracker.track(tracker.extract(frame, nullptr), *mapper.snapshot());
      if (!result.keyframe) continue;
      mapper.insert(std::move(*result.keyframe));
      mapper.refine({});
    }
    FeatureExtractor extractor(FeatureConfig{}, synthetic::camera());
    features = extractor.extract(room().render(kPathFrames, on_path(kPathFrames)), {});
    T_camera_world = on_path(kPathFrames).inverse();
  }
  LocalMapper mapper;
  Features features;
  SE3 T_camera_world;
};

MappedRoom& mapped_room() {
  static MappedRoom room_with_map;
  return room_with_map;
}

void local_map_matching(benchmark::State& state) {
  MappedRoom& mapped = mapped_room();
  const auto map = mapped.mapper.snapshot();
  const FrameSearch search(model(), *map, mapped.features);
  for (auto _ : state) {
    FrameMatches matches(mapped.features);
    benchmark::DoNotOptimize(search.match_local_map(mapped.T_camera_world, 4.0, matches));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(map->points.size()));
}
BENCHMARK(local_map_matching)->Unit(benchmark::kMillisecond);

void keyframe_matching(benchmark::State& state) {
  MappedRoom& mapped = mapped_room();
  const auto map = mapped.mapper.snapshot();
  const FrameSearch search(model(), *map, mapped.features);
  for (auto _ : state) benchmark::DoNotOptimize(search.match_keyframe(map->keyframes.back()));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(keyframe_matching)->Unit(benchmark::kMillisecond);

void pose_optimisation(benchmark::State& state) {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.5);
  const SE3 T_camera_world = synthetic::pose_at(0.05, 0.02, 0.03, 0.02);
  std::vector<PointMatch> matches;
  for (const Eigen::Vector3d& point : synthetic::random_points(generator, 500)) {
    matches.push_back({point, synthetic::sighting(T_camera_world, point)});
    matches.back().observation.pixel += Eigen::Vector2d(noise(generator), noise(generator));
  }
  for (auto _ : state) benchmark::DoNotOptimize(optimise_pose(model(), matches, SE3()));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(pose_optimisation)->Unit(benchmark::kMillisecond);

void local_bundle_adjustment(benchmark::State& state) {
  std::mt19937 generator(2);
  std::normal_distribution<double> noise(0.0, 0.005);
  BundleProblem problem;
  problem.points = synthetic::random_points(generator, 2000);
  for (int i = 0; i < 20; ++i) problem.cameras.push_back({on_path(i).inverse(), i >= 10});
  for (std::size_t camera = 0; camera < problem.cameras.size(); ++camera) {
    for (std::size_t point = camera % 4; point < problem.points.size(); point += 4) {
      const SE3& T_camera_world = problem.cameras[camera].T_camera_world;
      problem.sightings.push_back(
          {camera, point, synthetic::sighting(T_camera_world, problem.points[point])});
    }
  }
  for (Eigen::Vector3d& point : problem.points) {
    point += Eigen::Vector3d::NullaryExpr([&] { return noise(generator); });
  }
  for (auto _ : state) {
    state.PauseTiming();
    BundleProblem copy = problem;
    state.ResumeTiming();
    benchmark::DoNotOptimize(adjust_bundle(model(), {}, copy));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(local_bundle_adjustment)->Unit(benchmark::kMillisecond);

/// Extraction and tracking of a frame as slam does them, mapping left out of the time.
void whole_frame(benchmark::State& state) {
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < kPathFrames; ++i) {
    frames.push_back(room().render(static_cast<std::uint64_t>(i), on_path(i)));
  }
  for (auto _ : state) {
    state.PauseTiming();
    Tracker tracker(SlamConfig{}, synthetic::camera());
    LocalMapper mapper(SlamConfig{}, synthetic::camera());
    state.ResumeTiming();
    for (const RgbdFrame& frame : frames) {
      TrackResult result = tracker.track(tracker.extract(frame, nullptr), *mapper.snapshot());
      if (!result.keyframe) continue;
      state.PauseTiming();
      mapper.insert(std::move(*result.keyframe));
      mapper.refine({});
      (void)mapper.snapshot();
      state.ResumeTiming();
    }
  }
  state.SetItemsProcessed(state.iterations() * kPathFrames);
}
BENCHMARK(whole_frame)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tsg

BENCHMARK_MAIN();
