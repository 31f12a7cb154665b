// What telling moving features apart costs a frame, at VGA with 1000 features. Release preset only.

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "services/slam/lib/dynamic/class_policy.hpp"
#include "services/slam/lib/dynamic/dynamic_filter.hpp"
#include "services/slam/lib/dynamic/epipolar_coupling.hpp"
#include "services/slam/lib/dynamic/static_features.hpp"
#include "services/slam/lib/dynamic/synthetic_pairs.hpp"
#include "services/slam/lib/feature_extractor.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

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
  for ([[maybe_unused]] auto _ : state) {
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

/// A wall with four people and four chairs before it, all of which move; ready to be judged.
class Session {
 public:
  static constexpr int kFrames = 60;
  static constexpr int kKnown = 40;  // frames until there is a past to compare with

  Session() {
    synthetic::Scene scene(
        {{.z = 4.0, .corner = {-5.0, -4.0}, .extent = {10.0, 8.0}, .texture_seed = 1}});
    std::vector<std::string> classes;
    for (unsigned i = 0; i < 8; ++i) {
      scene.add({.z = 2.0 + 0.2 * i,
                 .corner = {0.0, -0.7 + 0.1 * i},
                 .extent = {0.3, 0.8},
                 .texture_seed = 2 + i,
                 .label = static_cast<std::uint8_t>(i + 1)});
      classes.emplace_back(i % 2 == 0 ? "person" : "chair");
    }
    FeatureExtractor extractor(config_.features, synthetic::camera());
    for (int frame = 0; frame < kFrames; ++frame) {
      for (std::size_t i = 0; i < 8; ++i) {
        scene.panel(i + 1).corner.x() = -1.3 + 0.32 * static_cast<double>(i) + 0.01 * frame;
      }
      frames_.push_back(scene.render(static_cast<std::uint64_t>(frame), SE3()));
      masks_.push_back(scene.mask(frames_.back(), SE3(), classes));
      features_.push_back(std::make_shared<const Features>(extractor.extract(
          frames_.back(), exact_verdicts(masks_.back(), config_.dynamic_filter))));
    }
  }

  /// How many features go on.
  std::size_t judge(int frame, bool with_masks, DynamicFilter& filter) const {
    const auto i = static_cast<std::size_t>(frame);
    const SE3 T_world_camera;
    const cv::Mat by_class =
        filter.judge_by_class(frames_[i], with_masks ? &masks_[i] : nullptr, T_world_camera);
    benchmark::DoNotOptimize(by_class.data);
    filter.note_features(features_[i]);
    const Judgement judgement = filter.judge_by_motion(*features_[i], &T_world_camera);
    const auto kept = keep_static(features_[i], judgement, model_.camera());
    filter.note_pose(T_world_camera);
    return kept.features->size();
  }

  [[nodiscard]] DynamicFilter make_filter() const { return {config_, model_}; }

 private:
  SlamConfig config_;
  ObservationModel model_{synthetic::camera(), config_};
  std::vector<RgbdFrame> frames_;
  std::vector<InstanceSegmentation> masks_;
  std::vector<std::shared_ptr<const Features>> features_;
};

void full(benchmark::State& state, bool with_masks) {
  static const Session kSession;
  std::unique_ptr<DynamicFilter> filter;
  int frame = Session::kFrames;
  std::size_t kept = 0;
  for ([[maybe_unused]] auto _ : state) {
    if (frame == Session::kFrames) {
      state.PauseTiming();
      filter = std::make_unique<DynamicFilter>(kSession.make_filter());
      for (frame = 0; frame < Session::kKnown; ++frame) kSession.judge(frame, with_masks, *filter);
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(kept = kSession.judge(frame++, with_masks, *filter));
  }
  state.counters["kept"] = static_cast<double>(kept);
}

BENCHMARK_CAPTURE(full, eight_instances, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(full, no_masks, false)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tsg

BENCHMARK_MAIN();
