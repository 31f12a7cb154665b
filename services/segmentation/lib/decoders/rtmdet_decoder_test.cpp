#include "services/segmentation/lib/decoders/rtmdet_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <opencv2/core.hpp>

#include "tests/support/made_networks.hpp"

namespace tsg {
namespace {

using test::MadeMasks;
using test::MadeNetwork;
using test::MadeObject;
using testing::HasSubstr;

ClassNames names_of(const MadeNetwork& network) { return {network.class_names(), "the test"}; }

MadeNetwork network_of(const std::vector<MadeObject>& objects,
                       MadeMasks kind = MadeMasks::kProbabilities) {
  return test::made_rtmdet({64, 32}, 3, objects, kind);
}

RtmdetDecoder decoder_for(const MadeNetwork& network) {
  return {value_or_throw(rtmdet_layout(network.description(), names_of(network))), {}};
}

Expected<DecodedInstances> decode(const MadeNetwork& network, cv::Mat& labels) {
  return decoder_for(network).decode(network.views(), make_letterbox({128, 64}, {64, 32}), labels);
}

TEST(RtmdetDecoder, FindsClassScoreBoxAndMaskInFramePixels) {
  const MadeObject object{
      .class_id = 2, .score = 0.8F, .centre = {0.5F, 0.5F}, .radii = {0.25F, 0.25F}};
  for (const auto kind : {MadeMasks::kProbabilities, MadeMasks::kLogits, MadeMasks::kZeroOrOne}) {
    cv::Mat labels;
    const auto found = decode(network_of({object}, kind), labels);
    ASSERT_TRUE(found.has_value()) << found.error().message;
    ASSERT_EQ(found->instances.size(), 1U);
    EXPECT_EQ(found->instances[0].class_name, "class 2");
    EXPECT_FLOAT_EQ(found->instances[0].score, 0.8F);
    EXPECT_EQ(found->instances[0].box, cv::Rect2f(32, 16, 64, 32));
    const double area = CV_PI * 32 * 16;
    EXPECT_NEAR(cv::countNonZero(labels), area, 0.05 * area);
  }
}

TEST(RtmdetDecoder, PutsTheHigherScoreOnTopAndDropsTheUnsure) {
  cv::Mat labels;
  const auto found = decode(network_of({{.class_id = 0, .score = 0.5F},
                                        {.class_id = 1, .score = 0.9F},
                                        {.class_id = 2, .score = 0.2F}}),
                            labels);
  ASSERT_TRUE(found.has_value());
  ASSERT_EQ(found->instances.size(), 2U);
  EXPECT_EQ(found->instances[0].class_name, "class 1");
  EXPECT_EQ(labels.at<std::uint8_t>(32, 64), 1);
  EXPECT_EQ(cv::countNonZero(labels == 2), 0);  // wholly covered
}

TEST(RtmdetDecoder, KeepsTheBestOfMoreInstancesThanAMessageHolds) {
  std::vector<MadeObject> objects(70);
  for (int i = 0; i < 70; ++i) {
    objects[static_cast<std::size_t>(i)].score = 0.3F + 0.01F * static_cast<float>(i);
  }
  cv::Mat labels;
  const auto found = decode(network_of(objects), labels);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->instances.size(), static_cast<std::size_t>(kMaxInstances));
  EXPECT_EQ(found->left_out, 70 - kMaxInstances);
  EXPECT_FLOAT_EQ(found->instances.front().score, 0.99F);
}

TEST(RtmdetDecoder, FindsNothingWhereTheNetworkDoes) {
  MadeNetwork network = network_of({});
  cv::Mat labels(64, 128, CV_8UC1, cv::Scalar(9));
  const RtmdetDecoder decoder = decoder_for(network_of({{}}));
  const auto found = decoder.decode(network.views(), make_letterbox({128, 64}, {64, 32}), labels);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_TRUE(found->instances.empty());
  EXPECT_EQ(cv::countNonZero(labels), 0);
}

void expect_error(const std::function<void(MadeNetwork&)>& damage,
                  ExitCode code,
                  const std::string& said) {
  MadeNetwork network = network_of({{.class_id = 1}});
  const RtmdetDecoder decoder = decoder_for(network);
  damage(network);
  cv::Mat labels;
  const auto found = decoder.decode(network.views(), make_letterbox({128, 64}, {64, 32}), labels);
  ASSERT_FALSE(found.has_value()) << said;
  EXPECT_EQ(found.error().code, code);
  EXPECT_THAT(found.error().message, HasSubstr(said));
}

TEST(RtmdetDecoder, WithholdsOutputsThatAreNotNumbersOrDoNotFit) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect_error([&](auto& network) { network.outputs[0].floats[4] = nan; }, ExitCode::kInvalidNumber,
               "NaN");
  expect_error([&](auto& network) { network.outputs[2].floats[9] = nan; }, ExitCode::kInvalidNumber,
               "NaN");
  expect_error([](auto& network) { network.outputs[1].integers[0] = 3; },
               ExitCode::kUnsupportedModel, "found class 3, but only 3 classes have names");
  expect_error([](auto& network) { network.outputs[1].integers[0] = -1; },
               ExitCode::kUnsupportedModel, "found class -1");
  expect_error([](auto& network) { network.outputs[2].floats.resize(16 * 8); },
               ExitCode::kUnsupportedModel, "export it with masks of the input's size");
}

TEST(RtmdetLayout, IsFoundInAnyOrderAndWithOpenDimensions) {
  ModelDescription model{.inputs = {{"input", {1, 3, 640, 640}}},
                         .outputs = {{"masks", {1, -1, -1, -1}},
                                     {"dets", {1, -1, 5}},
                                     {"labels", {1, -1}, ElementType::kInt64}}};
  const auto layout = rtmdet_layout(model, {{"person"}, "the test"});
  ASSERT_TRUE(layout.has_value()) << layout.error().message;
  EXPECT_EQ(layout->masks, 0U);
  EXPECT_EQ(layout->boxes, 1U);
  EXPECT_EQ(layout->classes, 2U);
  model.outputs[0].shape = {1, 100, 160, 160};
  const auto small = rtmdet_layout(model, {{"person"}, "the test"});
  ASSERT_FALSE(small.has_value());
  EXPECT_EQ(small.error().code, ExitCode::kUnsupportedModel);
  EXPECT_THAT(small.error().message, HasSubstr("masks float32 [1,100,160,160]"));
}

}  // namespace
}  // namespace tsg
