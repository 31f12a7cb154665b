#include "services/segmentation/lib/model_provider.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "services/segmentation/lib/decoders/yolo_seg_decoder.hpp"
#include "tests/support/shared_dir.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/tiny_yolo_seg.hpp"

namespace tsg {
namespace {

using test::OnnxWriter;
using test::TempFolder;
using test::TinyYoloSeg;
using testing::HasSubstr;

RgbdFrame frame_of(const cv::Mat& colour) {
  return {.seq = 17, .stamp_ns = 42, .camera = {}, .colour = colour, .depth = {}};
}

Expected<std::unique_ptr<ModelProvider>> make_tiny(const TempFolder& folder,
                                                   const TinyYoloSeg& network) {
  return ModelProvider::make(
      {.model = {.file = folder.write("tiny.onnx", network.bytes())}, .decoder = {}});
}

TEST(ModelProvider, AnswersWithTheFramesSeqStampAndSize) {
  const TempFolder folder;
  auto provider = make_tiny(folder, {});
  ASSERT_TRUE(provider.has_value()) << provider.error().message;
  EXPECT_EQ((*provider)->name(), "tiny.onnx");
  for (const cv::Size size : {cv::Size(64, 32), cv::Size(640, 320), cv::Size(128, 64)}) {
    const cv::Mat colour(size, CV_8UC3, cv::Scalar::all(0));
    cv::Mat labels;
    const auto result = (*provider)->segment(frame_of(colour), labels);
    ASSERT_TRUE(result.has_value()) << result.error().message;
    const InstanceSegmentation& found = result->segmentation;
    EXPECT_EQ(found.frame_seq, 17U);
    EXPECT_EQ(found.stamp_ns, 42);
    ASSERT_EQ(found.instances.size(), 1U);
    EXPECT_EQ(found.instances[0].class_name, "person");
    EXPECT_EQ(found.labels.size(), size);
    const double share = static_cast<double>(cv::countNonZero(found.labels)) / size.area();
    EXPECT_NEAR(share, 0.5, 0.05);
    EXPECT_GT(result->times.network_ns, 0);
  }
}

TEST(ModelProvider, WritesTheMaskIntoTheMemoryThatItIsGiven) {
  const TempFolder folder;
  auto provider = make_tiny(folder, {});
  ASSERT_TRUE(provider.has_value()) << provider.error().message;
  const cv::Mat colour(320, 640, CV_8UC3, cv::Scalar::all(0));
  std::vector<std::uint8_t> memory(640 * 320, 99);
  cv::Mat labels(320, 640, CV_8UC1, memory.data());
  const auto result = (*provider)->segment(frame_of(colour), labels);
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_EQ(result->segmentation.labels.data, memory.data());
  EXPECT_EQ(memory.at(160 * 640 + 100), 1);
  EXPECT_EQ(memory.at(160 * 640 + 600), 0);
}

TEST(ModelProvider, GivesAThingTheSameTrackIdInEveryFrame) {
  const TempFolder folder;
  auto provider = make_tiny(folder, {});
  ASSERT_TRUE(provider.has_value()) << provider.error().message;
  const cv::Mat colour(32, 64, CV_8UC3, cv::Scalar::all(0));
  std::vector<std::uint32_t> ids;
  for (int i = 0; i < 3; ++i) {
    RgbdFrame frame = frame_of(colour);
    frame.stamp_ns = 100'000'000 * i;
    cv::Mat labels;
    ids.push_back((*provider)->segment(frame, labels)->segmentation.instances.at(0).track_id);
  }
  EXPECT_NE(ids[0], 0U);
  EXPECT_EQ(ids, std::vector(3, ids[0]));
}

TEST(ModelProvider, TellsThatItsFileWasReplacedOrIsGoneAndGoesOn) {
  const TempFolder folder;
  auto provider = make_tiny(folder, {});
  ASSERT_TRUE(provider.has_value()) << provider.error().message;
  EXPECT_EQ((*provider)->state().problem, "");
  const cv::Mat colour(32, 64, CV_8UC3, cv::Scalar::all(0));
  cv::Mat labels;
  const auto still_works = [&] {
    return (*provider)->segment(frame_of(colour), labels).has_value();
  };
  folder.write("tiny.onnx", "something else");
  EXPECT_THAT((*provider)->state().problem, HasSubstr("tiny.onnx was replaced"));
  EXPECT_TRUE(still_works());
  std::filesystem::remove(folder / "tiny.onnx");
  EXPECT_THAT((*provider)->state().problem, HasSubstr("tiny.onnx is gone"));
  EXPECT_TRUE(still_works());
}

TEST(ModelProvider, RunsOnTheCpuAndSaysSoWhereTheGpuThatItShallRunOnIsNotToBeHad) {
  const TempFolder folder;
  for (const std::string gpu : {"cuda", "tensorrt"}) {
    ModelProviderConfig config{
        .model = {.file = folder.write("tiny.onnx", TinyYoloSeg{}.bytes()), .provider = gpu},
        .decoder = {}};
    auto provider = ModelProvider::make(config);
    ASSERT_TRUE(provider.has_value()) << provider.error().message;
    const ProviderState state = (*provider)->state();
    if (state.problem.empty()) GTEST_SKIP() << "this machine has a GPU for " << gpu;
    EXPECT_THAT(state.problem, HasSubstr("does not run on " + gpu));
    EXPECT_THAT(state.values,
                testing::Contains(std::pair<std::string, std::string>("runs_on", "cpu")));
    const cv::Mat colour(32, 64, CV_8UC3, cv::Scalar::all(0));
    cv::Mat labels;
    EXPECT_TRUE((*provider)->segment(frame_of(colour), labels).has_value());
    config.model.provider_required = true;
    const auto refused = ModelProvider::make(config);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ExitCode::kUnavailable);
    EXPECT_THAT(refused.error().message, HasSubstr("does not run on " + gpu));
  }
}

TEST(ModelProvider, BlamesADamagedFileAndNotTheGpuThatItShouldRunOn) {
  const TempFolder folder;
  const auto provider = ModelProvider::make(
      {.model = {.file = folder.write("notes.onnx", "a list"), .provider = "cuda"}, .decoder = {}});
  ASSERT_FALSE(provider.has_value());
  EXPECT_EQ(provider.error().code, ExitCode::kBadData);
}

TEST(ModelProvider, WithholdsTheMaskWhereTheNetworkGivesNaN) {
  const TempFolder folder;
  auto provider = make_tiny(folder, {.score = std::numeric_limits<float>::quiet_NaN()});
  ASSERT_TRUE(provider.has_value()) << provider.error().message;
  const cv::Mat colour(32, 64, CV_8UC3, cv::Scalar::all(0));
  cv::Mat labels;
  const auto result = (*provider)->segment(frame_of(colour), labels);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ExitCode::kInvalidNumber);
}

TEST(ModelProvider, NamesTheFileOfANetworkOfAnotherLayout) {
  OnnxWriter classifier;
  classifier.add_input("image", {1, 3, 32, 64});
  classifier.add_output("classes", {1, 3, 32, 64});
  classifier.add_node("Identity", {"image"}, "classes");
  const TempFolder folder;
  const auto provider = ModelProvider::make(
      {.model = {.file = folder.write("classifier.onnx", classifier.bytes())}, .decoder = {}});
  ASSERT_FALSE(provider.has_value());
  EXPECT_EQ(provider.error().code, ExitCode::kUnsupportedModel);
  EXPECT_THAT(provider.error().message, HasSubstr("classifier.onnx: the outputs are of no layout"));
}

// On a real network and real images, against what its own makers' tools find.
class YoloV8n : public testing::Test {
 protected:
  void SetUp() override {
    TSG_REQUIRE_SHARED("models/yolov8n-seg/model.onnx");
    TSG_REQUIRE_SHARED("data/tum_bits/fr3_walking_xyz_frames");
    std::ifstream file(model_file().replace_filename("expected.json"));
    expected_ = nlohmann::json::parse(file);
  }

  static std::filesystem::path model_file() {
    return test::shared_dir() / "models/yolov8n-seg/model.onnx";
  }
  static std::filesystem::path frames_folder() {
    return test::shared_dir() / "data/tum_bits/fr3_walking_xyz_frames";
  }

  nlohmann::json expected_;
};

void expect_same_detection(const nlohmann::json& expected,
                           const std::string& class_name,
                           float score,
                           const cv::Rect2f& box) {
  EXPECT_EQ(class_name, expected["class"].get<std::string>());
  EXPECT_NEAR(score, expected["score"].get<double>(), 1e-3);
  const auto corners = expected["box_xyxy"].get<std::vector<double>>();
  EXPECT_NEAR(box.x, corners[0], 0.5);
  EXPECT_NEAR(box.y, corners[1], 0.5);
  EXPECT_NEAR(box.br().x, corners[2], 0.5);
  EXPECT_NEAR(box.br().y, corners[3], 0.5);
}

TEST_F(YoloV8n, FindsWhatItsMakersToolsFind) {
  auto provider = ModelProvider::make({.model = {.file = model_file()}, .decoder = {}});
  ASSERT_TRUE(provider.has_value()) << provider.error().message;
  for (const auto& [name, frame] : expected_["frames"].items()) {
    SCOPED_TRACE(name);
    const cv::Mat colour = cv::imread(frames_folder() / name);
    cv::Mat labels;
    const auto result = (*provider)->segment(frame_of(colour), labels);
    ASSERT_TRUE(result.has_value()) << result.error().message;
    const auto& instances = result->segmentation.instances;
    ASSERT_EQ(instances.size(), frame["detections"].size());
    for (std::size_t i = 0; i < instances.size(); ++i) {
      SCOPED_TRACE(i);
      const auto& expected = frame["detections"][i];
      expect_same_detection(expected, instances[i].class_name, instances[i].score,
                            instances[i].box);
    }
  }
}

TEST_F(YoloV8n, GivesMasksOfTheSameArea) {
  auto model = OnnxModel::load({.file = model_file()});
  ASSERT_TRUE(model.has_value()) << model.error().message;
  const auto names = class_names_of(model->description());
  ASSERT_TRUE(names.has_value()) << names.error().message;
  const auto layout = yolo_seg_layout(model->description(), *names);
  ASSERT_TRUE(layout.has_value()) << layout.error().message;
  ASSERT_TRUE(model->allocate().has_value());
  const Letterbox letterbox = make_letterbox({640, 480}, layout->input_size);
  for (const auto& [name, frame] : expected_["frames"].items()) {
    SCOPED_TRACE(name);
    InputTensorWriter({640, 480}, {.size = layout->input_size})
        .write(cv::imread(frames_folder() / name), model->input(0));
    ASSERT_TRUE(model->run().has_value());
    const YoloSegTensors tensors{model->outputs()[0].floats, model->outputs()[1].floats};
    const auto detections = find_detections(*layout, {}, tensors);
    ASSERT_TRUE(detections.has_value());
    ASSERT_EQ(detections->size(), frame["detections"].size());
    for (std::size_t i = 0; i < detections->size(); ++i) {
      cv::Mat mask(480, 640, CV_8UC1, cv::Scalar(0));
      paint_detection({*layout, tensors, letterbox}, (*detections)[i], 1, mask);
      const double area = frame["detections"][i]["mask_area"].get<double>();
      EXPECT_NEAR(cv::countNonZero(mask), area, std::max(0.005 * area, 5.0)) << "instance " << i;
    }
  }
}

}  // namespace
}  // namespace tsg
