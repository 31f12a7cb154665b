#include "services/segmentation/lib/onnx_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/onnx_writer.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::OnnxWriter;
using test::TempFolder;
using testing::HasSubstr;
using testing::Pair;
using testing::UnorderedElementsAre;

std::string doubling_network() {
  OnnxWriter model;
  model.add_input("in", {1, 2, 3});
  model.add_output("out", {1, 2, 3});
  model.add_node("Add", {"in", "in"}, "out");
  model.add_metadata("names", "{0: 'x'}");
  return model.bytes();
}

void expect_load_error(const OnnxModelConfig& config, ExitCode code, const std::string& said) {
  const auto model = OnnxModel::load(config);
  ASSERT_FALSE(model.has_value());
  EXPECT_EQ(model.error().code, code) << model.error().message;
  EXPECT_THAT(model.error().message, HasSubstr(said));
}

TEST(OnnxModel, DescribesAndRunsANetwork) {
  const TempFolder folder;
  auto model = OnnxModel::load({.file = folder.write("double.onnx", doubling_network())});
  ASSERT_TRUE(model.has_value()) << model.error().message;
  EXPECT_EQ(model->description().inputs.at(0).to_string(), "in float32 [1,2,3]");
  EXPECT_EQ(model->description().outputs.at(0).to_string(), "out float32 [1,2,3]");
  EXPECT_THAT(model->description().metadata, UnorderedElementsAre(Pair("names", "{0: 'x'}")));

  ASSERT_TRUE(model->allocate().has_value());
  for (const float value : {1.5F, -4.0F}) {
    std::ranges::fill(model->input(0), value);
    ASSERT_TRUE(model->run().has_value());
    ASSERT_EQ(model->outputs().size(), 1U);
    EXPECT_THAT(model->outputs()[0].shape, testing::ElementsAre(1, 2, 3));
    EXPECT_THAT(model->outputs()[0].floats, testing::Each(2 * value));
  }
}

TEST(OnnxModel, DoesNotRunOnceCancelled) {
  const TempFolder folder;
  auto model = OnnxModel::load({.file = folder.write("double.onnx", doubling_network())});
  ASSERT_TRUE(model.has_value() && model->allocate().has_value());
  model->cancel();
  const auto ran = model->run();
  ASSERT_FALSE(ran.has_value());
  EXPECT_THAT(ran.error().message, HasSubstr("the network failed"));
}

TEST(OnnxModel, HasNoMemoryForAnInputOfNoFixedShape) {
  OnnxWriter writer;
  writer.add_input("in", {1, -1});
  writer.add_output("out", {1, -1});
  writer.add_node("Identity", {"in"}, "out");
  const TempFolder folder;
  auto model = OnnxModel::load({.file = folder.write("any.onnx", writer.bytes())});
  ASSERT_TRUE(model.has_value()) << model.error().message;
  const auto allocated = model->allocate();
  ASSERT_FALSE(allocated.has_value());
  EXPECT_EQ(allocated.error().code, ExitCode::kUnsupportedModel);
  EXPECT_THAT(allocated.error().message, HasSubstr("in float32 [1,?]"));
}

TEST(OnnxModel, GivesOutputsWhoseShapeShowsOnlyInARun) {
  OnnxWriter writer;  // of the 4 numbers those above zero
  const std::vector<float> zero{0.0F};
  writer.add_input("in", {4});
  writer.add_output("out", {1, -1});
  writer.add_constant("zero", {}, std::span(zero));
  const std::vector<float> numbers{1.0F, 2.0F, 3.0F, 4.0F};
  writer.add_constant("numbers", {1, 4}, std::span(numbers));
  writer.add_node("Greater", {"in", "zero"}, "chosen");
  writer.add_node("Compress", {"numbers", "chosen"}, "out");
  const TempFolder folder;
  auto model = OnnxModel::load({.file = folder.write("choose.onnx", writer.bytes())});
  ASSERT_TRUE(model.has_value()) << model.error().message;
  EXPECT_EQ(model->description().outputs.at(0).to_string(), "out float32 [1,?]");
  ASSERT_TRUE(model->allocate().has_value());
  for (const int chosen : {3, 0, 1}) {
    for (int i = 0; i < 4; ++i) {
      model->input(0)[static_cast<std::size_t>(i)] = i < chosen ? 1.0F : -1.0F;
    }
    ASSERT_TRUE(model->run().has_value());
    ASSERT_EQ(model->outputs().size(), 1U);
    EXPECT_THAT(model->outputs()[0].shape, testing::ElementsAre(1, chosen));
    EXPECT_EQ(model->outputs()[0].floats.size(), static_cast<std::size_t>(chosen));
  }
}

TEST(OnnxModel, GivesWholeNumbers) {
  OnnxWriter writer;
  const std::vector<std::int64_t> labels{3, -1, std::int64_t{1} << 40U};
  writer.add_input("in", {1, 2});
  writer.add_output("out", {1, 3}, /*is_integer=*/true);
  writer.add_constant("labels", {1, 3}, std::span(labels));
  writer.add_node("Identity", {"labels"}, "out");
  const TempFolder folder;
  auto model = OnnxModel::load({.file = folder.write("labels.onnx", writer.bytes())});
  ASSERT_TRUE(model.has_value()) << model.error().message;
  EXPECT_EQ(model->description().outputs.at(0).to_string(), "out int64 [1,3]");
  ASSERT_TRUE(model->allocate().has_value());
  ASSERT_TRUE(model->run().has_value());
  EXPECT_THAT(model->outputs()[0].integers, testing::ElementsAreArray(labels));
}

TEST(OnnxModel, NamesAMissingFileAndTheKeyToSet) {
  expect_load_error({.file = "/nowhere/model.onnx"}, ExitCode::kMissingInput,
                    "segmentation.model.file");
  expect_load_error({.file = "/nowhere/model.onnx"}, ExitCode::kMissingInput,
                    "/nowhere/model.onnx");
}

TEST(OnnxModel, RejectsFilesThatAreNotOnnx) {
  const TempFolder folder;
  const std::string whole = doubling_network();
  for (const std::string& content :
       {std::string("a text, not a network"), std::string(), whole.substr(0, whole.size() / 2)}) {
    expect_load_error({.file = folder.write("bad.onnx", content)}, ExitCode::kBadData, "bad.onnx");
  }
}

TEST(OnnxModel, RejectsOperatorsThatTheRuntimeLacks) {
  OnnxWriter writer;
  writer.add_input("in", {1, 2});
  writer.add_output("out", {1, 2});
  writer.add_node("NoSuchOperator", {"in"}, "out");
  const TempFolder folder;
  expect_load_error({.file = folder.write("odd.onnx", writer.bytes())}, ExitCode::kUnsupportedModel,
                    "NoSuchOperator");
}

TEST(OnnxModel, SaysHowToGetTheRuntimeWhereItIsMissing) {
  const TempFolder folder;
  const std::string file = folder.write("double.onnx", doubling_network());
  expect_load_error({.file = file, .runtime_library = "/nowhere/libonnxruntime.so"},
                    ExitCode::kUnavailable, "run deploy/install-deps");
  expect_load_error({.file = file, .runtime_library = "libm.so.6"}, ExitCode::kUnavailable,
                    "libm.so.6 is not ONNX Runtime");
}

TEST(OnnxModelConfig, NamesAnImpossibleNumberOfThreads) {
  EXPECT_TRUE(OnnxModelConfig{}.problems().empty());
  EXPECT_EQ((OnnxModelConfig{.threads = 0}).problems().size(), 1U);
}

}  // namespace
}  // namespace tsg
