// Stages of one frame through a real YOLO-seg network: image to tensor, network, tensors to
// instances. Target: the first and the last together at most a tenth of the network.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>

#include "services/segmentation/lib/letterbox.hpp"
#include "services/segmentation/lib/onnx_model.hpp"
#include "services/segmentation/lib/yolo_seg_decoder.hpp"
#include "services/segmentation/lib/yolo_seg_layout.hpp"
#include "tests/support/shared_dir.hpp"

namespace tsg {
namespace {

/// The network and an image with ten instances; empty where they are not on this machine.
class Stages {
 public:
  static std::optional<Stages> load(int threads) {
    const auto shared = test::shared_dir();
    const auto file = shared / "models/yolov8n-seg/model.onnx";
    const auto image = shared / "data/tum_bits/fr3_walking_xyz_frames/rgb_1341846313.592026.png";
    if (!std::filesystem::exists(file) || !std::filesystem::exists(image)) return std::nullopt;
    auto model = value_or_throw(OnnxModel::load({.file = file, .threads = threads}));
    auto layout = value_or_throw(yolo_seg_layout(model.description()));
    throw_on_error(model.allocate());
    return Stages(std::move(model), std::move(layout), cv::imread(image));
  }

  void preprocess() { writer_.write(image_, model_.input(0)); }
  void run_network() { throw_on_error(model_.run()); }
  DecodedInstances postprocess() {
    const YoloSegTensors tensors{model_.output(0), model_.output(1)};
    return value_or_throw(
        decode_yolo_seg({layout_, tensors, writer_.letterbox()}, YoloSegConfig{}, labels_));
  }

 private:
  Stages(OnnxModel model, YoloSegLayout layout, cv::Mat image)
      : model_(std::move(model)),
        layout_(std::move(layout)),
        image_(std::move(image)),
        writer_(make_letterbox(image_.size(), layout_.input_size)) {}

  OnnxModel model_;
  YoloSegLayout layout_;
  cv::Mat image_;
  InputTensorWriter writer_;
  cv::Mat labels_;
};

std::optional<Stages> stages_or_skip(benchmark::State& state, int threads) {
  auto stages = Stages::load(threads);
  if (!stages) state.SkipWithError("no model or no image: set TSG_SHARED_DIR");
  return stages;
}

void segmentation_preprocess(benchmark::State& state) {
  auto stages = stages_or_skip(state, 1);
  if (!stages) return;
  for ([[maybe_unused]] auto iteration : state) stages->preprocess();
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(segmentation_preprocess)->Unit(benchmark::kMillisecond);

void segmentation_network(benchmark::State& state) {
  auto stages = stages_or_skip(state, static_cast<int>(state.range(0)));
  if (!stages) return;
  stages->preprocess();
  for ([[maybe_unused]] auto iteration : state) stages->run_network();
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(segmentation_network)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void segmentation_postprocess(benchmark::State& state) {
  auto stages = stages_or_skip(state, 2);
  if (!stages) return;
  stages->preprocess();
  stages->run_network();
  for ([[maybe_unused]] auto iteration : state) {
    benchmark::DoNotOptimize(stages->postprocess().instances.size());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(segmentation_postprocess)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tsg

BENCHMARK_MAIN();
