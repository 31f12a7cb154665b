// Stages of one frame through a real YOLO-seg network: image to tensor, network, tensors to
// instances. Target: the first and the last together at most a tenth of the network. And the last
// stage of SOLOv2, on made-up outputs of real size.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>

#include "services/segmentation/lib/instance_tracker.hpp"
#include "services/segmentation/lib/letterbox.hpp"
#include "services/segmentation/lib/make_decoder.hpp"
#include "services/segmentation/lib/onnx_model.hpp"
#include "services/segmentation/lib/remote/image_codec.hpp"
#include "tests/support/made_networks.hpp"
#include "tests/support/onnx_writer.hpp"
#include "tests/support/shared_dir.hpp"
#include "tests/support/temp_folder.hpp"

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
    auto decoder = value_or_throw(make_decoder(model.description(), {}, std::nullopt));
    throw_on_error(model.allocate());
    return Stages(std::move(model), std::move(decoder), cv::imread(image));
  }

  void preprocess() { writer_.write(image_, model_.input(0)); }
  void run_network() { throw_on_error(model_.run()); }
  [[nodiscard]] const cv::Mat& image() const { return image_; }
  [[nodiscard]] const cv::Mat& labels() const { return labels_; }
  DecodedInstances postprocess() {
    return value_or_throw(decoder_->decode(model_.outputs(), writer_.letterbox(), labels_));
  }

 private:
  Stages(OnnxModel model, std::unique_ptr<InstanceDecoder> decoder, cv::Mat image)
      : model_(std::move(model)),
        decoder_(std::move(decoder)),
        image_(std::move(image)),
        writer_(image_.size(), decoder_->input_format()) {}

  OnnxModel model_;
  std::unique_ptr<InstanceDecoder> decoder_;
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

/// A light SOLOv2 of COCO for CPUs: 80 classes, kernels of 128, 320 x 256 pixels; eight objects,
/// each seen by four cells, which makes some 30 candidates; `noise` 1 adds 800 that are none. The
/// frame is VGA.
void segmentation_solov2_postprocess(benchmark::State& state) {
  std::mt19937 random(1);
  const test::MadeSolov2 made{.input_size = {320, 256},
                              .classes = 80,
                              .kernel_length = 128,
                              .is_merged = state.range(0) != 0,
                              .noise = state.range(1) != 0 ? 1.0F : 0.5F};
  const auto network = made.network(test::random_objects(8, made.classes, random), random);
  const ClassNames names{network.class_names(), "the benchmark"};
  const auto decoder = value_or_throw(make_decoder(network.description(), {}, names));
  const InputFormat& format = decoder->input_format();
  const Letterbox letterbox = make_letterbox({640, 480}, format.size, format.placement);
  const auto outputs = network.views();
  cv::Mat labels;
  std::size_t instances = 0;
  for ([[maybe_unused]] auto iteration : state) {
    instances = value_or_throw(decoder->decode(outputs, letterbox, labels)).instances.size();
  }
  state.counters["instances"] = static_cast<double>(instances);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(segmentation_solov2_postprocess)
    ->ArgNames({"merged", "noise"})
    ->Args({0, 0})
    ->Args({1, 0})
    ->Args({0, 1})
    ->Unit(benchmark::kMillisecond);

/// A network of nothing but 3 x 3 convolutions of 64 channels at a quarter of VGA: what a network
/// of so many billions of multiply-adds takes at best.
std::string convolutions(int layers) {
  constexpr int kChannels = 64;
  test::OnnxWriter model;
  const test::OnnxWriter::Shape shape{1, kChannels, 120, 160};
  model.add_input("layer0", shape);
  model.add_output("layer" + std::to_string(layers), shape);
  const std::vector<float> weights(std::size_t{9} * kChannels * kChannels, 0.001F);
  model.add_constant("weights", {kChannels, kChannels, 3, 3}, weights);
  for (int i = 0; i < layers; ++i) {
    model.add_node("Conv", {"layer" + std::to_string(i), "weights"},
                   "layer" + std::to_string(i + 1));
  }
  return model.bytes();
}

void segmentation_convolutions(benchmark::State& state) {
  constexpr double kPerLayer = 9.0 * 64 * 64 * 120 * 160;
  const int layers =
      static_cast<int>(std::lround(static_cast<double>(state.range(0)) * 1e9 / kPerLayer));
  const test::TempFolder folder;
  auto model = value_or_throw(
      OnnxModel::load({.file = folder.write("convolutions.onnx", convolutions(layers)),
                       .threads = static_cast<int>(state.range(1))}));
  throw_on_error(model.allocate());
  std::ranges::fill(model.input(0), 0.5F);
  for ([[maybe_unused]] auto iteration : state) throw_on_error(model.run());
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(segmentation_convolutions)
    ->ArgNames({"billions", "threads"})
    ->Args({5, 1})
    ->Args({5, 2})
    ->Args({12, 2})
    ->Args({43, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

/// A real image and its labels, on their way to another host and back.
struct Travelling {
  cv::Mat colour;
  cv::Mat labels;

  static std::optional<Travelling> load() {
    auto stages = Stages::load(2);
    if (!stages) return std::nullopt;
    stages->preprocess();
    stages->run_network();
    (void)stages->postprocess();
    return Travelling{stages->image().clone(), stages->labels().clone()};
  }
};

void remote_encode_colour(benchmark::State& state) {
  const auto travelling = Travelling::load();
  if (!travelling) return state.SkipWithError("no model or no image: set TSG_SHARED_DIR");
  std::size_t bytes = 0;
  for ([[maybe_unused]] auto iteration : state) {
    bytes = value_or_throw(encode_colour(travelling->colour, 80)).size();
  }
  state.counters["bytes"] = static_cast<double>(bytes);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(remote_encode_colour)->Unit(benchmark::kMillisecond);

void remote_decode_colour(benchmark::State& state) {
  const auto travelling = Travelling::load();
  if (!travelling) return state.SkipWithError("no model or no image: set TSG_SHARED_DIR");
  const ImageBytes jpeg = value_or_throw(encode_colour(travelling->colour, 80));
  for ([[maybe_unused]] auto iteration : state) {
    benchmark::DoNotOptimize(value_or_throw(decode_colour(jpeg, travelling->colour.size())).data);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(remote_decode_colour)->Unit(benchmark::kMillisecond);

void remote_encode_labels(benchmark::State& state) {
  const auto travelling = Travelling::load();
  if (!travelling) return state.SkipWithError("no model or no image: set TSG_SHARED_DIR");
  std::size_t bytes = 0;
  for ([[maybe_unused]] auto iteration : state) {
    bytes = value_or_throw(encode_labels(travelling->labels)).size();
  }
  state.counters["bytes"] = static_cast<double>(bytes);
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(remote_encode_labels)->Unit(benchmark::kMillisecond);

void remote_decode_labels(benchmark::State& state) {
  const auto travelling = Travelling::load();
  if (!travelling) return state.SkipWithError("no model or no image: set TSG_SHARED_DIR");
  const ImageBytes png = value_or_throw(encode_labels(travelling->labels));
  cv::Mat labels(travelling->labels.size(), CV_8UC1);
  for ([[maybe_unused]] auto iteration : state) throw_on_error(decode_labels(png, 64, labels));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(remote_decode_labels)->Unit(benchmark::kMillisecond);

/// Eight things that keep their numbers from one mask of a VGA frame to the next.
void segmentation_tracking(benchmark::State& state) {
  InstanceSegmentation mask;
  mask.labels = cv::Mat::zeros(480, 640, CV_8UC1);
  for (int i = 0; i < 8; ++i) {
    const cv::Rect box(80 * i, 40 * (i % 3), 120, 300);
    const cv::Rect inside = box & cv::Rect(0, 0, 640, 480);
    mask.labels(inside).setTo(i + 1);
    mask.instances.push_back({.class_name = "person", .score = 0.9F, .box = inside});
  }
  InstanceTracker tracker;
  for ([[maybe_unused]] auto iteration : state) {
    mask.stamp_ns += 100'000'000;
    tracker.follow(mask);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(segmentation_tracking)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tsg

BENCHMARK_MAIN();
