// What tsg-segmentation says and how it exits where it cannot start: no RouDi runs here.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "common/bus/roudi.hpp"
#include "common/core/error.hpp"
#include "tests/support/made_networks.hpp"
#include "tests/support/onnx_writer.hpp"
#include "tests/support/running_segmentation.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/tiny_yolo_seg.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// Expects the service not to start with `overrides`, on a bus that needs no RouDi.
void expect_start_error(std::vector<std::string> overrides,
                        ExitCode code,
                        const std::vector<std::string>& said) {
  overrides.emplace_back("bus.use_shared_memory=false");
  RunningSegmentation service(overrides);
  EXPECT_EQ(service.exit_code(20s), static_cast<int>(code)) << service.output();
  for (const std::string& part : said) EXPECT_THAT(service.output(), HasSubstr(part));
}

std::vector<std::string> with_model(const std::string& file) {
  return {"segmentation.provider=model", "segmentation.model.file=" + file};
}

TEST(SegmentationStart, NeedsRoudiAndSaysHowToStartIt) {
  if (check_roudi()) GTEST_SKIP() << "somebody runs RouDi on this host";
  RunningSegmentation service({"segmentation.provider=dataset"});
  EXPECT_EQ(service.exit_code(5s), static_cast<int>(ExitCode::kUnavailable));
  EXPECT_THAT(service.output(), HasSubstr("RouDi"));
}

TEST(SegmentationStart, NamesAnUnknownKey) {
  expect_start_error({"segmentation.speed=9"}, ExitCode::kConfig,
                     {"unknown key segmentation.speed"});
}

TEST(SegmentationStart, NamesTheKeyOfAProviderThatIsNotSet) {
  expect_start_error({"segmentation.provider=dataset"}, ExitCode::kConfig,
                     {"segmentation.dataset.folder is not set"});
}

TEST(SegmentationStart, NamesAModelThatIsNotThere) {
  expect_start_error(with_model("/nowhere/model.onnx"), ExitCode::kMissingInput,
                     {"/nowhere/model.onnx", "segmentation.model.file"});
}

TEST(SegmentationStart, RejectsAFileThatIsNotOnnx) {
  const TempFolder folder;
  expect_start_error(with_model(folder.write("notes.onnx", "a shopping list")), ExitCode::kBadData,
                     {"notes.onnx", "is not an ONNX file"});
}

TEST(SegmentationStart, RejectsANetworkOfAnotherLayoutAndSaysWhichIsKnown) {
  OnnxWriter classifier;
  classifier.add_input("image", {1, 3, 32, 64});
  classifier.add_output("classes", {1, 3, 32, 64});
  classifier.add_node("Identity", {"image"}, "classes");
  const TempFolder folder;
  expect_start_error(with_model(folder.write("classifier.onnx", classifier.bytes())),
                     ExitCode::kUnsupportedModel,
                     {"classifier.onnx", "classes float32 [1,3,32,64]", "YOLOv8/11"});
}

TEST(SegmentationStart, RejectsAnInputThatIsNotOneImage) {
  OnnxWriter model;
  model.add_input("image", {3, 32, 64});
  model.add_output("out", {3, 32, 64});
  model.add_node("Identity", {"image"}, "out");
  const TempFolder folder;
  expect_start_error(with_model(folder.write("flat.onnx", model.bytes())),
                     ExitCode::kUnsupportedModel,
                     {"flat.onnx", "not one float32 image [1,3,H,W]", "image float32 [3,32,64]"});
}

TEST(SegmentationStart, SaysHowToNameClassesWhereTheModelDoesNot) {
  std::mt19937 random(1);
  const MadeSolov2 made{.classes = 2, .kernel_length = 3};
  const std::string network = made.network({}, random).onnx(/*has_names=*/false);
  const TempFolder folder;
  expect_start_error(with_model(folder.write("nameless.onnx", network)),
                     ExitCode::kUnsupportedModel,
                     {"nameless.onnx", "does not name its classes", "segmentation.model.labels"});
}

TEST(SegmentationStart, RejectsLabelsThatAreNotThereOrNotThoseOfTheNetwork) {
  const TempFolder folder;
  const auto with_labels = [&](const std::string& labels) {
    std::vector<std::string> overrides =
        with_model(folder.write("tiny.onnx", TinyYoloSeg{}.bytes()));
    overrides.push_back("segmentation.model.labels=" + labels);
    return overrides;
  };
  expect_start_error(with_labels("/nowhere/coco.txt"), ExitCode::kMissingInput,
                     {"/nowhere/coco.txt", "segmentation.model.labels"});
  expect_start_error(with_labels(folder.write("three.txt", "person\nchair\ntv\n")),
                     ExitCode::kBadData, {"has 2 classes", "three.txt names 3"});
}

TEST(SegmentationStart, SaysHowToGetTheRuntimeWhereItIsMissing) {
  const TempFolder folder;
  std::vector<std::string> overrides = with_model(folder.write("tiny.onnx", TinyYoloSeg{}.bytes()));
  overrides.emplace_back("segmentation.model.runtime_library=/nowhere/libonnxruntime.so.1");
  expect_start_error(overrides, ExitCode::kUnavailable,
                     {"/nowhere/libonnxruntime.so.1", "run deploy/install-deps"});
}

TEST(SegmentationStart, NamesACpuThatThisHostLacks) {
  expect_start_error({"segmentation.provider=dataset", "segmentation.cpus=0,1000"},
                     ExitCode::kConfig, {"segmentation.cpus names CPU 1000", "this host has CPUs"});
}

TEST(SegmentationStart, RefusesToRunElsewhereThanOnTheGpuThatIsRequired) {
  const TempFolder folder;
  std::vector<std::string> overrides = with_model(folder.write("tiny.onnx", TinyYoloSeg{}.bytes()));
  overrides.emplace_back("segmentation.model.provider_required=true");
  overrides.emplace_back("segmentation.model.provider=tensorrt");
  if (std::filesystem::exists("/dev/nvidiactl")) GTEST_SKIP() << "this machine has an NVIDIA GPU";
  expect_start_error(overrides, ExitCode::kUnavailable,
                     {"does not run on tensorrt", "segmentation.model.runtime_library"});
}

TEST(SegmentationStart, NamesADatasetFolderThatIsNotThereOrHasNoMasks) {
  const TempFolder folder;
  expect_start_error({"segmentation.provider=dataset", "segmentation.dataset.folder=/nowhere"},
                     ExitCode::kMissingInput, {"/nowhere"});
  folder.write("instances.json", R"({"instances": {}})");
  std::filesystem::create_directory(folder / "mask");
  expect_start_error(
      {"segmentation.provider=dataset", "segmentation.dataset.folder=" + folder.path().string()},
      ExitCode::kEmptyInput, {"mask"});
}

TEST(SegmentationStart, ChecksAConfigurationWithoutJoiningTheBus) {
  const ChildCommand check{.program = TSG_BIN_DIR "/tsg-segmentation",
                           .arguments = {"--check-config"}};
  auto process = ChildProcess::spawn(check);
  ASSERT_TRUE(process.has_value());
  const auto& ended = process->wait(10s);
  ASSERT_TRUE(ended.has_value());
  EXPECT_TRUE(ended->is_success()) << ended->describe();
}

}  // namespace
}  // namespace tsg::test
