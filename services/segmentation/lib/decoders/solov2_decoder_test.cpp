#include "services/segmentation/lib/decoders/solov2_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/made_networks.hpp"

namespace tsg {
namespace {

using test::MadeNetwork;
using test::MadeObject;
using test::MadeSolov2;
using testing::HasSubstr;

struct DecodedNetwork {
  Expected<DecodedInstances> found;
  cv::Mat labels;
};

DecodedNetwork decode(const MadeNetwork& network,
                      cv::Size frame_size,
                      const DecoderConfig& config = {}) {
  const ClassNames names{network.class_names(), "the test"};
  auto layout = value_or_throw(solov2_layout(network.description(), names));
  const Solov2Decoder decoder(std::move(layout), config);
  const InputFormat& format = decoder.input_format();
  DecodedNetwork decoded;
  decoded.found = decoder.decode(
      network.views(), make_letterbox(frame_size, format.size, format.placement), decoded.labels);
  return decoded;
}

MadeNetwork without_noise(const std::vector<MadeObject>& objects, bool is_merged = false) {
  std::mt19937 random(1);
  return MadeSolov2{.kernel_length = 100, .is_merged = is_merged, .noise = 0.0F}.network(objects,
                                                                                         random);
}

TEST(Solov2Decoder, FindsClassMaskAndBoxInFramePixels) {
  const MadeObject object{.class_id = 4, .centre = {0.25F, 0.5F}, .radii = {0.2F, 0.3F}};
  const DecodedNetwork decoded = decode(without_noise({object}), {320, 256});
  ASSERT_TRUE(decoded.found.has_value()) << decoded.found.error().message;
  ASSERT_EQ(decoded.found->instances.size(), 1U);
  const Instance& found = decoded.found->instances[0];
  EXPECT_EQ(found.class_name, "class 4");
  EXPECT_LT(found.score, 0.9F);  // the class's, times the mean probability inside
  EXPECT_GT(found.score, 0.8F);
  EXPECT_NEAR(found.box.x, 0.05F * 320, 4.0F);
  EXPECT_NEAR(found.box.br().x, 0.45F * 320, 4.0F);
  EXPECT_NEAR(found.box.y, 0.2F * 256, 4.0F);
  EXPECT_NEAR(found.box.br().y, 0.8F * 256, 4.0F);
  EXPECT_EQ(cv::Rect2f(cv::boundingRect(decoded.labels)), found.box);
  EXPECT_EQ(decoded.labels.at<std::uint8_t>(128, 80), 1);
}

TEST(Solov2Decoder, CutsThePaddingOff) {
  // The input is 160 x 128; a frame of 160 x 64 fills its upper half, all of which is the object.
  const MadeObject object{.centre = {0.5F, 0.25F}, .radii = {2.0F, 2.0F}};
  const DecodedNetwork decoded = decode(without_noise({object}), {160, 64});
  ASSERT_TRUE(decoded.found.has_value()) << decoded.found.error().message;
  EXPECT_EQ(decoded.labels.size(), cv::Size(160, 64));
  EXPECT_EQ(cv::countNonZero(decoded.labels), 160 * 64);
}

TEST(Solov2Decoder, FindsTheSameInRawAndInMergedOutputs) {
  std::mt19937 random(3);
  const auto objects = test::random_objects(8, 7, random);
  const DecodedNetwork raw = decode(without_noise(objects, false), {320, 256});
  const DecodedNetwork merged = decode(without_noise(objects, true), {320, 256});
  ASSERT_TRUE(raw.found.has_value() && merged.found.has_value());
  ASSERT_GE(raw.found->instances.size(), 4U);
  ASSERT_EQ(raw.found->instances.size(), merged.found->instances.size());
  EXPECT_EQ(cv::countNonZero(raw.labels != merged.labels), 0);
}

TEST(Solov2Decoder, PutsTheHigherScoreOnTopAndFirst) {
  const MadeObject worse{.class_id = 1, .score = 0.6F, .centre = {0.4F, 0.5F}};
  const MadeObject better{.class_id = 2, .score = 0.9F, .centre = {0.6F, 0.5F}};
  const DecodedNetwork decoded = decode(without_noise({worse, better}), {160, 128});
  ASSERT_TRUE(decoded.found.has_value());
  ASSERT_EQ(decoded.found->instances.size(), 2U);
  EXPECT_EQ(decoded.found->instances[0].class_name, "class 2");
  EXPECT_EQ(decoded.labels.at<std::uint8_t>(64, 80), 1);  // where both are
  EXPECT_EQ(decoded.labels.at<std::uint8_t>(64, 48), 2);
}

TEST(Solov2Decoder, DropsWhatIsBelowTheThresholdOrTooSmallForItsGrid) {
  const MadeObject unsure{.score = 0.3F};
  EXPECT_EQ(decode(without_noise({unsure}), {160, 128}, {.score_threshold = 0.25})
                .found->instances.size(),
            1U);
  EXPECT_EQ(decode(without_noise({unsure}), {160, 128}, {.score_threshold = 0.35})
                .found->instances.size(),
            0U);
  const MadeObject tiny{.radii = {0.03F, 0.03F}};  // 1 x 1 samples, at stride 8
  EXPECT_EQ(decode(without_noise({tiny}), {160, 128}).found->instances.size(), 0U);
}

TEST(Solov2Decoder, KeepsTheBestOfMoreInstancesThanAMessageHolds) {
  std::vector<MadeObject> objects;
  objects.reserve(80);
  for (int i = 0; i < 80; ++i) {
    const int row = i / 10;
    const float x = (static_cast<float>(i % 10) + 0.5F) / 10.0F;
    const float y = (static_cast<float>(row) + 0.5F) / 8.0F;
    objects.push_back(
        {.score = 0.5F + 0.005F * static_cast<float>(i), .centre = {x, y}, .radii = {0.08F, 0.1F}});
  }
  std::mt19937 random(1);
  const MadeSolov2 made{.input_size = {320, 256}, .kernel_length = 100, .noise = 0.0F};
  const DecodedNetwork decoded = decode(made.network(objects, random), {320, 256});
  ASSERT_TRUE(decoded.found.has_value());
  EXPECT_EQ(decoded.found->instances.size(), static_cast<std::size_t>(kMaxInstances));
  EXPECT_GE(decoded.found->left_out, 1);
  EXPECT_GT(decoded.found->instances.front().score, decoded.found->instances.back().score);
}

TEST(Solov2Decoder, EmptiesAReusedLabelImage) {
  const MadeNetwork network = without_noise({});
  const ClassNames names{network.class_names(), "the test"};
  const Solov2Decoder decoder(value_or_throw(solov2_layout(network.description(), names)), {});
  cv::Mat labels(128, 160, CV_8UC1, cv::Scalar(9));
  const void* memory = labels.data;
  const auto found =
      decoder.decode(network.views(), make_letterbox({160, 128}, {160, 128}), labels);
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->instances.empty());
  EXPECT_EQ(cv::countNonZero(labels), 0);
  EXPECT_EQ(labels.data, memory);
}

TEST(Solov2Decoder, WithholdsOutputsThatAreNotNumbers) {
  for (const float poison :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (std::size_t i = 0; i < 11; ++i) {
      MadeNetwork network = without_noise({{}});
      network.outputs[i].floats[3] = poison;
      const DecodedNetwork decoded = decode(network, {160, 128});
      ASSERT_FALSE(decoded.found.has_value()) << "output " << i;
      EXPECT_EQ(decoded.found.error().code, ExitCode::kInvalidNumber);
      EXPECT_THAT(decoded.found.error().message, HasSubstr("NaN"));
    }
  }
}

TEST(Solov2Decoder, IsShownRgbNormalisedAtTheTopLeftWithZerosBeside) {
  const MadeNetwork network = without_noise({});
  const ClassNames names{network.class_names(), "the test"};
  const Solov2Decoder decoder(value_or_throw(solov2_layout(network.description(), names)), {});
  const cv::Mat red(64, 160, CV_8UC3, cv::Scalar(0, 0, 255));
  constexpr std::size_t kPlane = std::size_t{160} * 128;
  std::vector<float> tensor(3 * kPlane);
  InputTensorWriter(red.size(), decoder.input_format()).write(red, tensor);
  EXPECT_NEAR(tensor[0], (255 - 123.675) / 58.395, 1e-5);
  EXPECT_NEAR(tensor[kPlane], -116.28 / 57.12, 1e-5);
  EXPECT_NEAR(tensor[2 * kPlane], -103.53 / 57.375, 1e-5);
  EXPECT_EQ(tensor[kPlane / 2], 0.0F);  // below the frame
}

}  // namespace
}  // namespace tsg
