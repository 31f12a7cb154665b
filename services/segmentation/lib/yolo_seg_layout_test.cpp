#include "services/segmentation/lib/yolo_seg_layout.hpp"

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
          .metadata = {{"names", "{0: 'person', 1: 'tv'}"}}};
}

void expect_unsupported(const std::function<void(ModelDescription&)>& change,
                        const std::string& said) {
  ModelDescription model = small_model();
  change(model);
  const auto layout = yolo_seg_layout(model);
  ASSERT_FALSE(layout.has_value()) << said;
  EXPECT_EQ(layout.error().code, ExitCode::kUnsupportedModel);
  EXPECT_THAT(layout.error().message, HasSubstr(said));
  EXPECT_THAT(layout.error().message, HasSubstr("dynamic=False"));  // the fix
}

TEST(YoloSegLayout, IsReadFromShapesAndNames) {
  const auto layout = yolo_seg_layout(small_model());
  ASSERT_TRUE(layout.has_value()) << layout.error().message;
  EXPECT_EQ(layout->input_size, cv::Size(64, 32));
  EXPECT_EQ(layout->prototype_size, cv::Size(16, 8));
  EXPECT_EQ(layout->anchors, 42);
  EXPECT_EQ(layout->coefficients, 3);
  EXPECT_THAT(layout->class_names, ElementsAre("person", "tv"));
}

TEST(YoloSegLayout, RejectsAnInputThatIsNoImage) {
  const auto said = "the input is not one float32 image";
  expect_unsupported([](auto& model) { model.inputs.clear(); }, said);
  expect_unsupported([](auto& model) { model.inputs[0].shape = {1, 3, 32}; }, said);
  expect_unsupported([](auto& model) { model.inputs[0].shape = {1, 1, 32, 64}; }, said);
  expect_unsupported([](auto& model) { model.inputs[0].is_float32 = false; }, said);
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
        model.outputs[0].shape = {1, 42, 9};
      },
      "should have 9 numbers per anchor");
  expect_unsupported(
      [](auto& model) {
        model.outputs[1].shape = {1, 3, 16, 32};
      },
      "not a quarter of the input");
}

TEST(YoloSegLayout, RejectsAModelWithoutClassNames) {
  expect_unsupported([](auto& model) { model.metadata.clear(); }, "no key `names`");
}

TEST(ClassNames, MayBeInEitherQuoteAndHoldEscapes) {
  const auto names = parse_class_names(R"({0: 'hot dog', 1: "driver's \"seat\"", 2:'it\'s'})");
  ASSERT_TRUE(names.has_value()) << names.error().message;
  EXPECT_THAT(*names, ElementsAre("hot dog", "driver's \"seat\"", "it's"));
}

TEST(ClassNames, AreRejectedWhereNotADictionaryInOrder) {
  for (const char* text : {"", "{", "{}", "person", "{1: 'person'}", "{0: 'a', 2: 'b'}", "{0: 'a'",
                           "{0: 'a', }", "{0: a}", "{0: 'a}", "{0: ''}", "{x: 'a'}"}) {
    const auto names = parse_class_names(text);
    ASSERT_FALSE(names.has_value()) << text;
    EXPECT_EQ(names.error().code, ExitCode::kUnsupportedModel);
  }
}

TEST(ClassNames, AreRejectedWhereAMessageHasNoRoomForThem) {
  EXPECT_TRUE(parse_class_names("{0: '" + std::string(31, 'a') + "'}").has_value());
  const auto names = parse_class_names("{0: '" + std::string(32, 'a') + "'}");
  ASSERT_FALSE(names.has_value());
  EXPECT_EQ(names.error().code, ExitCode::kUnsupportedModel);
  EXPECT_THAT(names.error().message, HasSubstr("31 bytes"));
}

}  // namespace
}  // namespace tsg
