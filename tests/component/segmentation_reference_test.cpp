// Decoders of networks against plain ones in numpy (tests/reference/segmentation), on made-up
// outputs and on those of a real network: the same instances, the same masks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "services/segmentation/lib/make_decoder.hpp"
#include "services/segmentation/lib/onnx_model.hpp"
#include "tests/support/made_networks.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/shared_dir.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::MadeMasks;
using test::MadeNetwork;
using test::MadeOutput;
using test::MadeSolov2;

struct ReferenceInstance {
  int class_id = 0;
  double score = 0.0;
  cv::Mat mask;  ///< CV_8UC1, 1 inside, of the frame's size
};

/// What is decoded.
struct Case {
  std::string script;
  MadeNetwork network;
  cv::Size frame_size;
  DecoderConfig config = {};
};

std::string write_tensor(const test::TempFolder& folder, const MadeOutput& output) {
  const std::string name = output.name + ".raw";
  const auto write = [&](const auto& numbers) {
    folder.write(name, {reinterpret_cast<const char*>(numbers.data()),
                        numbers.size() * sizeof(numbers.front())});
  };
  if (output.is_integer) {
    write(output.integers);
  } else {
    write(output.floats);
  }
  return name;
}

void write_request(const test::TempFolder& folder, const Case& asked) {
  const cv::Size input = asked.network.input_size;
  nlohmann::json request{{"frame", {asked.frame_size.width, asked.frame_size.height}},
                         {"input", {input.width, input.height}},
                         {"score_threshold", asked.config.score_threshold},
                         {"nms_iou", asked.config.nms_iou},
                         {"classes", asked.network.classes}};
  for (const MadeOutput& output : asked.network.outputs) {
    request["tensors"].push_back({{"file", write_tensor(folder, output)},
                                  {"type", output.is_integer ? "int64" : "float32"},
                                  {"shape", output.shape}});
  }
  folder.write("request.json", request.dump());
}

std::vector<ReferenceInstance> reference(const Case& asked) {
  const test::TempFolder folder;
  write_request(folder, asked);
  // Debian's, which has Debian's numpy, whatever python3 comes first in PATH.
  const auto run = test::run_program(
      "/usr/bin/python3",
      {TSG_SOURCE_DIR "/tests/reference/segmentation/" + asked.script, folder.path().string()});
  if (!run.end.is_success()) {
    ADD_FAILURE() << asked.script
                  << " needs Debian's python3-numpy (deploy/install-deps): " << run.output;
    return {};
  }
  const auto found = nlohmann::json::parse(test::content_of(folder / "instances.json"));
  std::string masks = test::content_of(folder / "masks.raw");
  const auto area = static_cast<std::size_t>(asked.frame_size.area());
  std::vector<ReferenceInstance> instances;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const cv::Mat mask(asked.frame_size, CV_8UC1, masks.data() + i * area);
    instances.push_back({found[i]["class"], found[i]["score"], mask.clone()});
  }
  return instances;
}

struct Decoded {
  DecodedInstances found;
  cv::Mat labels;
};

std::optional<Decoded> decode(const Case& asked, const MadeNetwork& network) {
  const ClassNames names{network.class_names(), "the test"};
  const auto decoder = make_decoder(network.description(), asked.config, names);
  if (!decoder) {
    ADD_FAILURE() << decoder.error().message;
    return std::nullopt;
  }
  const InputFormat& format = (*decoder)->input_format();
  const Letterbox letterbox = make_letterbox(asked.frame_size, format.size, format.placement);
  Decoded decoded;
  auto found = (*decoder)->decode(network.views(), letterbox, decoded.labels);
  if (!found) {
    ADD_FAILURE() << found.error().message;
    return std::nullopt;
  }
  decoded.found = std::move(*found);
  return decoded;
}

/// Expects an IoU of at least 0.99. What better instances cover is not seen in a label image, so
/// that of some masks only a rim is left: there, two pixels may differ.
void expect_same_mask(const cv::Mat& expected, const cv::Mat& mask) {
  const int different = cv::countNonZero(expected != mask);
  const int both = cv::countNonZero(expected | mask);
  EXPECT_LE(different, std::max(0.01 * both, 2.0)) << "of " << both << " pixels";
}

void expect_same_instances(const std::vector<ReferenceInstance>& expected, const Decoded& decoded) {
  const auto& instances = decoded.found.instances;
  ASSERT_EQ(instances.size() + static_cast<std::size_t>(decoded.found.left_out), expected.size());
  cv::Mat free(decoded.labels.size(), CV_8UC1, cv::Scalar(1));
  for (std::size_t i = 0; i < instances.size(); ++i) {
    SCOPED_TRACE("instance " + std::to_string(i));
    EXPECT_EQ(instances[i].class_name, "class " + std::to_string(expected[i].class_id));
    EXPECT_NEAR(instances[i].score, expected[i].score, 1e-4);
    const cv::Mat visible = expected[i].mask & free;
    expect_same_mask(visible, (decoded.labels == static_cast<double>(i + 1)) & 1);
    free.setTo(0, expected[i].mask);
  }
}

/// The network's outputs in another order.
MadeNetwork shuffled(MadeNetwork network, std::mt19937& random) {
  std::shuffle(network.outputs.begin(), network.outputs.end(), random);
  return network;
}

TEST(SegmentationReference, AgreesOnRawSolov2WhateverTheOrderOfItsOutputs) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 random(seed);
    const MadeSolov2 made{.grids = seed % 2 == 0 ? std::array{40, 36, 24, 16, 12}
                                                 : std::array{20, 18, 12, 8, 6}};
    const auto objects = test::random_objects(12, made.classes, random);
    const cv::Size frame = seed < 3 ? cv::Size(320, 240) : cv::Size(150, 100);
    // So low that what points-NMS and matrix NMS leave of duplicates shows.
    const Case asked{"solov2.py", made.network(objects, random), frame, {.score_threshold = 0.06}};
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto expected = reference(asked);
    EXPECT_GE(expected.size(), 6U);
    const auto decoded = decode(asked, shuffled(asked.network, random));
    if (decoded) expect_same_instances(expected, *decoded);
  }
}

TEST(SegmentationReference, AgreesOnMergedSolov2WithAndWithoutABatch) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 random(seed);
    const MadeSolov2 made{.is_merged = true};
    const auto objects = test::random_objects(12, made.classes, random);
    const Case asked{
        "solov2.py", made.network(objects, random), {200, 160}, {.score_threshold = 0.06}};
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto expected = reference(asked);
    EXPECT_GE(expected.size(), 6U);
    MadeNetwork network = shuffled(asked.network, random);
    for (MadeOutput& output : network.outputs) {
      const bool has_batch = output.shape.size() == 4;
      if (seed % 2 == 0 && !has_batch) output.shape.insert(output.shape.begin(), 1);
      if (seed % 2 != 0 && has_batch) output.shape.erase(output.shape.begin());
    }
    const auto decoded = decode(asked, network);
    if (decoded) expect_same_instances(expected, *decoded);
  }
}

TEST(SegmentationReference, AgreesOnSolov2WithMoreInstancesThanAMessageHolds) {
  std::mt19937 random(9);
  const MadeSolov2 made{.kernel_length = 90};
  const auto objects = test::random_objects(90, made.classes, random);
  const Case asked{
      "solov2.py", made.network(objects, random), {320, 240}, {.score_threshold = 0.1}};
  const auto expected = reference(asked);
  EXPECT_GT(expected.size(), 64U);
  const auto decoded = decode(asked, asked.network);
  if (decoded) expect_same_instances(expected, *decoded);
}

TEST(SegmentationReference, AgreesOnRtmdetWhateverItsMasksAre) {
  unsigned seed = 0;
  for (const auto kind : {MadeMasks::kProbabilities, MadeMasks::kLogits, MadeMasks::kZeroOrOne}) {
    for (const cv::Size frame : {cv::Size(320, 240), cv::Size(70, 90)}) {
      std::mt19937 random(++seed);
      const auto objects = test::random_objects(15, 5, random);
      const Case asked{"rtmdet.py",
                       test::made_rtmdet({160, 160}, 5, objects, kind),
                       frame,
                       {.score_threshold = 0.5}};
      SCOPED_TRACE("seed " + std::to_string(seed));
      const auto expected = reference(asked);
      EXPECT_GE(expected.size(), 6U);
      const auto decoded = decode(asked, shuffled(asked.network, random));
      if (decoded) expect_same_instances(expected, *decoded);
    }
  }
}

TEST(SegmentationReference, AgreesOnYoloSeg) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 random(seed);
    const auto objects = test::random_objects(15, 3, random);
    const cv::Size frame = seed < 3 ? cv::Size(320, 240) : cv::Size(90, 130);
    const Case asked{"yolo_seg.py", test::made_yolo_seg({160, 128}, 3, objects), frame};
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto expected = reference(asked);
    EXPECT_GE(expected.size(), 6U);
    const auto decoded = decode(asked, asked.network);
    if (decoded) expect_same_instances(expected, *decoded);
  }
}

/// The outputs of a network for an image, copied.
MadeNetwork outputs_for(OnnxModel& model, const InputFormat& format, const cv::Mat& image) {
  InputTensorWriter(image.size(), format).write(image, model.input(0));
  throw_on_error(model.run());
  MadeNetwork network{.input_size = format.size, .classes = 80};
  for (std::size_t i = 0; i < model.outputs().size(); ++i) {
    const TensorView& view = model.outputs()[i];
    network.outputs.push_back({.name = model.description().outputs[i].name,
                               .shape = view.shape,
                               .floats = {view.floats.begin(), view.floats.end()}});
  }
  return network;
}

TEST(SegmentationReference, AgreesOnARealYoloSegAndRealImages) {
  TSG_REQUIRE_SHARED("models/yolov8n-seg/model.onnx");
  TSG_REQUIRE_SHARED("data/tum_bits/fr3_walking_xyz_frames");
  OnnxModelConfig config{.file = test::shared_dir() / "models/yolov8n-seg/model.onnx"};
  OnnxModel model = value_or_throw(OnnxModel::load(config));
  throw_on_error(model.allocate());
  const auto decoder = value_or_throw(make_decoder(model.description(), {}, std::nullopt));
  int images = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           test::shared_dir() / "data/tum_bits/fr3_walking_xyz_frames")) {
    if (!entry.path().filename().string().starts_with("rgb_")) continue;
    SCOPED_TRACE(entry.path());
    const cv::Mat image = cv::imread(entry.path());
    const Case asked{"yolo_seg.py", outputs_for(model, decoder->input_format(), image),
                     image.size()};
    const auto expected = reference(asked);
    EXPECT_GE(expected.size(), 3U);
    const auto decoded = decode(asked, asked.network);
    if (decoded) expect_same_instances(expected, *decoded);
    ++images;
  }
  EXPECT_GE(images, 1);
}

}  // namespace
}  // namespace tsg
