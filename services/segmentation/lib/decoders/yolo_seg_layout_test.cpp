#include "services/segmentation/lib/decoders/yolo_seg_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace tsg {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A network of two classes for 64 x 32 images, with 3 prototypes.
ModelDescription small_model() {
  return {.inputs = {{"images", {1, 3, 32, 64}}},
          .outputs = {{"output0", {1, 4 + 2 + 3, 42}}, {"output1", {1, 3, 8, 16}}},
          .metadata = {}};
}

const ClassNames kNames{.names = {"person", "tv"}, .source = "the labels file two.txt"};

void expect_unsupported(const std::function<void(ModelDescription&)>& change,
                        const std::string& said) {
  ModelDescription model = small_model();
  change(model);
  const auto layout = yolo_seg_layout(model, kNames);
  ASSERT_FALSE(layout.has_value()) << said;
  EXPECT_EQ(layout.error().code, ExitCode::kUnsupportedModel);
  EXPECT_THAT(layout.error().message, HasSubstr(said));
  EXPECT_THAT(layout.error().message, HasSubstr("dynamic=False"));  // the fix
}

TEST(YoloSegLayout, IsReadFromShapesAndNames) {
  const auto layout = yolo_seg_layout(small_model(), kNames);
  ASSERT_TRUE(layout.has_value()) << layout.error().message;
  EXPECT_EQ(layout->input_size, cv::Size(64, 32));
  EXPECT_EQ(layout->prototype_size, cv::Size(16, 8));
  EXPECT_EQ(layout->anchors, 42);
  EXPECT_EQ(layout->coefficients, 3);
  EXPECT_THAT(layout->class_names, ElementsAre("person", "tv"));
}

TEST(YoloSegLayout, RejectsAnInputThatIsNoImage) {
  const std::string said = "the input is not one float32 image";
  expect_unsupported([](auto& model) { model.inputs.clear(); }, said);
  expect_unsupported([](auto& model) { model.inputs[0].shape = {1, 3, 32}; }, said);
  expect_unsupported([](auto& model) { model.inputs[0].shape = {1, 1, 32, 64}; }, said);
  expect_unsupported([](auto& model) { model.inputs[0].type = ElementType::kInt64; }, said);
  expect_unsupported([](auto& model) { model.inputs[0].shape = {2, 3, 32, 64}; }, said);
}

TEST(YoloSegLayout, RejectsAnInputOfNoFixedSizeAndShowsIt) {
  expect_unsupported([](auto& model) { model.inputs[0].shape = {1, 3, -1, -1}; }, "[1,3,?,?]");
}

TEST(YoloSegLayout, RejectsADetectorWithoutMasks) {
  expect_unsupported([](auto& model) { model.outputs.pop_back(); }, "the outputs are not");
}

TEST(YoloSegLayout, RejectsOutputsOfAnotherShape) {
  expect_unsupported(
      [](auto& model) {
        model.outputs[0].shape = {1, 9, 42, 1};
      },
      "the outputs are not");
  expect_unsupported(
      [](auto& model) {
        model.outputs[0].shape = {1, 7, 42};
      },
      "has no room for 4 numbers");
  expect_unsupported(
      [](auto& model) {
        model.outputs[1].shape = {1, 3, 16, 32};
      },
      "not a quarter of the input");
}

TEST(YoloSegLayout, RejectsAnotherNumberOfClassNames) {
  const ClassNames three{
      {"person", "chair", "tv"}, "the labels file three.txt", ExitCode::kBadData};
  const auto layout = yolo_seg_layout(small_model(), three);
  ASSERT_FALSE(layout.has_value());
  EXPECT_EQ(layout.error().code, ExitCode::kBadData);
  EXPECT_THAT(layout.error().message,
              HasSubstr("has 2 classes, but the labels file three.txt names 3"));
}

}  // namespace
}  // namespace tsg
