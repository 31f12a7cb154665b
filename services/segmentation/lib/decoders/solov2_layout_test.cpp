#include "services/segmentation/lib/decoders/solov2_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace tsg {
namespace {

using testing::HasSubstr;

ClassNames names_of(int count) {
  return {std::vector<std::string>(static_cast<std::size_t>(count), "thing"), "the labels file x"};
}

/// As SOLOv2's head returns them: scores, kernels, feature; for an input of 320 x 256.
ModelDescription raw_model(int classes, int kernel_length) {
  ModelDescription model{.inputs = {{"image", {1, 3, 256, 320}}}};
  for (const int channels : {classes, kernel_length}) {
    for (const int size : {40, 36, 24, 16, 12}) {
      model.outputs.push_back({std::to_string(model.outputs.size()), {1, channels, size, size}});
    }
  }
  model.outputs.push_back({"10", {1, kernel_length, 64, 80}});
  return model;
}

ModelDescription merged_model(int classes, int kernel_length) {
  return {
      .inputs = {{"image", {1, 3, 256, 320}}},
      .outputs = {
          {"a", {3872, classes}}, {"b", {3872, kernel_length}}, {"c", {1, kernel_length, 64, 80}}}};
}

void expect_raw_in_order(const ModelDescription& model, int classes) {
  const auto layout = solov2_layout(model, names_of(classes));
  ASSERT_TRUE(layout.has_value()) << layout.error().message;
  EXPECT_FALSE(layout->is_merged);
  EXPECT_EQ(layout->feature, 10U);
  for (std::size_t level = 0; level < 5; ++level) {
    EXPECT_EQ(layout->grids.at(level).categories, level);
    EXPECT_EQ(layout->grids.at(level).kernels, 5 + level);
  }
}

TEST(Solov2Layout, IsReadFromShapes) {
  const auto layout = solov2_layout(raw_model(80, 128), names_of(80));
  ASSERT_TRUE(layout.has_value()) << layout.error().message;
  EXPECT_EQ(layout->input_size, cv::Size(320, 256));
  EXPECT_EQ(layout->mask_size, cv::Size(80, 64));
  EXPECT_EQ(layout->kernel_length, 128);
  const std::array<int, 5> sizes{40, 36, 24, 16, 12};
  const std::array<int, 5> strides{8, 8, 16, 32, 32};
  for (std::size_t level = 0; level < 5; ++level) {
    EXPECT_EQ(layout->grids.at(level).size, sizes.at(level));
    EXPECT_EQ(layout->grids.at(level).stride, strides.at(level));
  }
  expect_raw_in_order(raw_model(80, 128), 80);
}

TEST(Solov2Layout, IsTheSameWithoutABatch) {
  ModelDescription model = raw_model(80, 128);
  for (auto& output : model.outputs) output.shape.erase(output.shape.begin());
  expect_raw_in_order(model, 80);
}

TEST(Solov2Layout, FindsScoresAndKernelsOfEqualLengthByOrder) {
  expect_raw_in_order(raw_model(128, 128), 128);
}

TEST(Solov2Layout, FindsScoresAndKernelsOfEqualLengthByName) {
  ModelDescription model = raw_model(128, 128);
  std::rotate(model.outputs.begin(), model.outputs.begin() + 5, model.outputs.begin() + 10);
  for (std::size_t i = 0; i < 5; ++i) model.outputs[i].name = "kernel_pred_" + std::to_string(i);
  const auto layout = solov2_layout(model, names_of(128));
  ASSERT_TRUE(layout.has_value()) << layout.error().message;
  EXPECT_EQ(layout->grids[0].kernels, 0U);
  EXPECT_EQ(layout->grids[0].categories, 5U);
}

TEST(Solov2Layout, TellsAFeatureFromAGridOfItsSize) {
  ModelDescription model = raw_model(80, 128);
  model.inputs[0].shape = {1, 3, 160, 160};
  model.outputs.back().shape = {1, 128, 40, 40};
  expect_raw_in_order(model, 80);
  std::rotate(model.outputs.begin(), model.outputs.begin() + 10, model.outputs.end());
  const auto layout = solov2_layout(model, names_of(80));
  ASSERT_TRUE(layout.has_value()) << layout.error().message;
  EXPECT_EQ(layout->grids[0].categories, 1U);
}

TEST(Solov2Layout, OfMergedOutputsHasTheCellsOfTheGridsOneAfterAnother) {
  const auto layout = solov2_layout(merged_model(80, 128), names_of(80));
  ASSERT_TRUE(layout.has_value()) << layout.error().message;
  EXPECT_TRUE(layout->is_merged);
  EXPECT_EQ(layout->feature, 2U);
  EXPECT_EQ(layout->grids[0].categories, 0U);
  EXPECT_EQ(layout->grids[0].kernels, 1U);
  EXPECT_EQ(layout->grids[1].first_cell, 1600U);
  EXPECT_EQ(layout->grids[4].first_cell, 3728U);
}

void expect_unsupported(ModelDescription model,
                        const std::function<void(ModelDescription&)>& change,
                        const std::string& said) {
  change(model);
  const auto layout = solov2_layout(model, names_of(80));
  ASSERT_FALSE(layout.has_value()) << said;
  EXPECT_EQ(layout.error().code, ExitCode::kUnsupportedModel);
  EXPECT_THAT(layout.error().message, HasSubstr(said));
}

TEST(Solov2Layout, RejectsWhatDoesNotFitTogether) {
  const ModelDescription raw = raw_model(80, 128);
  const ModelDescription merged = merged_model(80, 128);
  const std::string said = "the outputs are not those of SOLOv2";
  expect_unsupported(
      raw,
      [](auto& model) {
        model.outputs[3].shape = {1, 80, 16, 17};
      },
      said);
  expect_unsupported(
      raw,
      [](auto& model) {
        model.outputs[3].shape = {1, 80, 15, 15};
      },
      said);
  expect_unsupported(
      raw,
      [](auto& model) {
        model.outputs[3].shape = {1, 81, 16, 16};
      },
      said);
  expect_unsupported(
      raw,
      [](auto& model) {
        model.outputs[10].shape = {1, 128, 32, 40};
      },
      said);
  expect_unsupported(
      raw, [](auto& model) { model.outputs.pop_back(); }, said);
  expect_unsupported(
      merged,
      [](auto& model) {
        model.outputs[0].shape = {3871, 80};
      },
      said);
  expect_unsupported(
      merged,
      [](auto& model) {
        model.outputs[1].shape = {3872, 64};
      },
      said);
  expect_unsupported(
      merged,
      [](auto& model) {
        model.outputs[2].shape = {1, 128, 8, 8};
      },
      said);
  expect_unsupported(
      raw, [](auto& model) { model.outputs[0].shape[2] = -1; }, "not all float32 of fixed shape");
  expect_unsupported(
      raw,
      [](auto& model) {
        model.inputs[0].shape = {1, 3, 255, 320};
      },
      "multiples of 4");
}

TEST(Solov2Layout, RejectsAnotherNumberOfClassNames) {
  for (const auto& model : {raw_model(80, 128), merged_model(80, 128)}) {
    const auto layout = solov2_layout(model, names_of(81));
    ASSERT_FALSE(layout.has_value());
    EXPECT_THAT(layout.error().message,
                HasSubstr("has 80 classes, but the labels file x names 81"));
  }
}

}  // namespace
}  // namespace tsg
