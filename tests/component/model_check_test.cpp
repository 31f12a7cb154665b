// `tsgctl model check` as a user meets it: what it says of good networks and of bad files, and how
// it exits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "common/core/error.hpp"
#include "tests/support/made_networks.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/tiny_yolo_seg.hpp"

namespace tsg::test {
namespace {

using ::testing::HasSubstr;

const std::vector<MadeObject> kTwoObjects{{.class_id = 1, .centre = {0.3F, 0.5F}},
                                          {.class_id = 0, .centre = {0.75F, 0.5F}}};

MadeNetwork solov2(bool is_merged) {
  std::mt19937 random(1);
  const MadeSolov2 made{
      .input_size = {64, 32},
      .grids = is_merged ? std::array{40, 36, 24, 16, 12} : std::array{12, 10, 8, 6, 4},
      .classes = 2,
      .kernel_length = 3,
      .is_merged = is_merged,
      .noise = 0.0F};
  return made.network(kTwoObjects, random);
}

MadeNetwork rtmdet() { return made_rtmdet({64, 32}, 2, kTwoObjects, MadeMasks::kProbabilities); }

ProgramResult check(const std::string& file, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"model", "check", file};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(TSG_BIN_DIR "/tsgctl", arguments);
}

class ModelCheck : public ::testing::Test {
 protected:
  void expect_error(const std::string& content,
                    ExitCode code,
                    const std::vector<std::string>& said,
                    const std::vector<std::string>& more = {}) {
    const ProgramResult result = check(folder_.write("net.onnx", content), more);
    EXPECT_EQ(result.end.exit_code, static_cast<int>(code)) << result.output;
    EXPECT_THAT(result.output, HasSubstr("tsgctl: error: "));
    EXPECT_THAT(result.output, HasSubstr("net.onnx"));
    for (const std::string& part : said) EXPECT_THAT(result.output, HasSubstr(part));
  }

  void expect_understood(const std::string& content,
                         const std::string& layout,
                         int instances,
                         const std::vector<std::string>& more = {"--json"}) {
    const ProgramResult result = check(folder_.write("net.onnx", content), more);
    ASSERT_EQ(result.end.exit_code, 0) << result.output;
    const auto told = nlohmann::json::parse(result.output);
    EXPECT_EQ(told["layout"], layout);
    EXPECT_EQ(told["instances_in_noise"], instances);
    EXPECT_EQ(told["width"], 64);
    EXPECT_EQ(told["classes"].size(), 2U);
    EXPECT_GT(told["network_ms"], 0.0);
  }

  TempFolder folder_;
};

TEST_F(ModelCheck, TellsEachLayoutAndWhatItFinds) {
  expect_understood(TinyYoloSeg{}.bytes(), "YOLOv8/11-seg", 1);
  expect_understood(solov2(false).onnx(true), "SOLOv2, 11 raw outputs", 2);
  expect_understood(solov2(true).onnx(true), "SOLOv2, merged outputs", 2);
  expect_understood(rtmdet().onnx(true), "RTMDet-Ins", 2);
  expect_understood(rtmdet().onnx(true, /*is_dynamic=*/true), "RTMDet-Ins", 2);
}

TEST_F(ModelCheck, SaysInWordsWhatTheServiceDoesWithANetwork) {
  const ProgramResult result = check(folder_.write("net.onnx", solov2(false).onnx(true)));
  EXPECT_EQ(result.end.exit_code, 0) << result.output;
  for (const char* part :
       {"net.onnx: a network that the segmentation service can run", "SOLOv2, 11 raw outputs",
        "image float32 [1,3,32,64]", "at the top left, as RGB",
        "2, from metadata: class 0, class 1", "for the network on 2 threads"}) {
    EXPECT_THAT(result.output, HasSubstr(part));
  }
}

TEST_F(ModelCheck, TakesClassNamesFromALabelsFile) {
  const std::string labels = folder_.write("two.txt", "person\ndining table\n");
  const auto more = std::vector<std::string>{"--json", "--labels", labels};
  expect_understood(solov2(false).onnx(false), "SOLOv2, 11 raw outputs", 2, more);
  expect_understood(rtmdet().onnx(false), "RTMDet-Ins", 2, more);
}

TEST_F(ModelCheck, SaysHowToNameClassesWhereNoneAreNamed) {
  expect_error(solov2(true).onnx(false), ExitCode::kUnsupportedModel,
               {"does not name its classes", "--labels"});
}

TEST_F(ModelCheck, RejectsLabelsThatAreNotThoseOfTheNetwork) {
  const auto with = [&](const std::string& name, const std::string& content) {
    return std::vector<std::string>{"--labels", folder_.write(name, content).string()};
  };
  const std::string network = solov2(false).onnx(false);
  expect_error(network, ExitCode::kBadData, {"has 2 classes", "one.txt names 1"},
               with("one.txt", "person\n"));
  expect_error(network, ExitCode::kBadData, {"has 2 classes", "three.txt names 3"},
               with("three.txt", "background\nperson\ntv\n"));
  expect_error(network, ExitCode::kBadData, {"gap.txt:2", "without a name"},
               with("gap.txt", "person\n\ntv\n"));
  expect_error(network, ExitCode::kEmptyInput, {"empty.txt is empty"}, with("empty.txt", ""));
  expect_error(network, ExitCode::kMissingInput, {"/nowhere.txt"}, {"--labels", "/nowhere.txt"});
  // How many classes RTMDet-Ins has shows only in what it finds.
  expect_error(rtmdet().onnx(false), ExitCode::kUnsupportedModel,
               {"found class 1", "only 1 classes have names"}, with("one.txt", "person\n"));
}

TEST_F(ModelCheck, RejectsFilesThatAreNoNetworkOrNotThere) {
  expect_error("a shopping list", ExitCode::kBadData, {"is not an ONNX file"});
  expect_error("", ExitCode::kBadData, {"is empty"});
  const ProgramResult absent = check("/nowhere/net.onnx");
  EXPECT_EQ(absent.end.exit_code, static_cast<int>(ExitCode::kMissingInput)) << absent.output;
}

TEST_F(ModelCheck, RejectsAnUnknownLayoutAndSaysWhatWasFoundAndWhatIsSupported) {
  OnnxWriter classifier;
  classifier.add_input("image", {1, 3, 32, 64});
  classifier.add_output("classes", {1, 3, 32, 64});
  classifier.add_node("Identity", {"image"}, "classes");
  expect_error(classifier.bytes(), ExitCode::kUnsupportedModel,
               {"classes float32 [1,3,32,64]", "SOLOv2", "RTMDet-Ins", "YOLOv8/11"});
  MadeNetwork no_solo = solov2(false);
  no_solo.outputs[2].shape = {1, 2, 5, 20};
  no_solo.outputs[2].floats.resize(200);
  expect_error(no_solo.onnx(true), ExitCode::kUnsupportedModel,
               {"not those of SOLOv2", "cate_1 float32 [1,2,5,20]", "11 raw outputs"});
}

TEST_F(ModelCheck, RejectsAnInputThatIsNotOneImageOfFixedSize) {
  for (const OnnxWriter::Shape& shape :
       {OnnxWriter::Shape{3, 32, 64}, {1, 1, 32, 64}, {2, 3, 32, 64}}) {
    OnnxWriter model;
    model.add_input("image", shape);
    model.add_output("out", shape);
    model.add_node("Identity", {"image"}, "out");
    expect_error(model.bytes(), ExitCode::kUnsupportedModel, {"not one float32 image [1,3,H,W]"});
  }
  OnnxWriter open;
  open.add_input("image", {1, 3, -1, -1});
  open.add_output("out", {1, 3, -1, -1});
  open.add_node("Identity", {"image"}, "out");
  expect_error(open.bytes(), ExitCode::kUnsupportedModel,
               {"no fixed size", "[1,3,?,?]", "dynamic=False"});
}

TEST_F(ModelCheck, FindsOutThatANetworkGivesNaN) {
  MadeNetwork network = solov2(false);
  network.outputs.back().floats[7] = std::numeric_limits<float>::quiet_NaN();
  expect_error(network.onnx(true), ExitCode::kInvalidNumber, {"run on noise", "NaN"});
  const TinyYoloSeg yolo{.score = std::numeric_limits<float>::quiet_NaN()};
  expect_error(yolo.bytes(), ExitCode::kInvalidNumber, {"run on noise", "NaN"});
}

TEST_F(ModelCheck, HasHelpWithExamples) {
  for (const auto& arguments : {std::vector<std::string>{"model", "--help"},
                                std::vector<std::string>{"model", "check", "--help"}}) {
    const ProgramResult result = run_program(TSG_BIN_DIR "/tsgctl", arguments);
    EXPECT_EQ(result.end.exit_code, 0);
    EXPECT_THAT(result.output, HasSubstr("Examples:"));
  }
}

}  // namespace
}  // namespace tsg::test
