#include "services/segmentation/lib/remote/image_codec.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>

namespace tsg {
namespace {

cv::Mat_<std::uint8_t> some_labels() {
  cv::Mat_<std::uint8_t> labels(48, 64, std::uint8_t{0});
  labels(cv::Rect(5, 6, 20, 30)) = 1;
  labels(cv::Rect(30, 0, 34, 48)) = 2;
  return labels;
}

TEST(ImageCodec, GivesLabelsBackExactlyIntoTheMemoryThatIsThere) {
  const cv::Mat labels = some_labels();
  const auto png = encode_labels(labels);
  ASSERT_TRUE(png.has_value()) << png.error().message;
  EXPECT_LT(png->size(), 1000U);
  std::vector<std::uint8_t> memory(64 * 48, 77);
  cv::Mat decoded(48, 64, CV_8UC1, memory.data());
  ASSERT_TRUE(decode_labels(*png, 2, decoded).has_value());
  EXPECT_EQ(decoded.data, memory.data());
  EXPECT_EQ(cv::countNonZero(decoded != labels), 0);
}

TEST(ImageCodec, GivesColoursBackNearly) {
  cv::Mat bgr(48, 64, CV_8UC3, cv::Scalar(200, 100, 50));
  bgr(cv::Rect(0, 0, 32, 48)).setTo(cv::Scalar(10, 20, 230));
  const auto jpeg = encode_colour(bgr, 90);
  ASSERT_TRUE(jpeg.has_value()) << jpeg.error().message;
  const auto decoded = decode_colour(*jpeg, bgr.size());
  ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
  EXPECT_LT(cv::norm(*decoded, bgr, cv::NORM_L1) / static_cast<double>(3 * bgr.total()), 3.0);
  EXPECT_LT(encode_colour(bgr, 10)->size(), jpeg->size());
}

TEST(ImageCodec, RefusesImagesOfAnotherSizeThanTheySay) {
  const auto png = encode_labels(some_labels());
  cv::Mat larger(480, 640, CV_8UC1);
  EXPECT_EQ(decode_labels(*png, 2, larger).error().code, ExitCode::kBadData);
  const auto jpeg = encode_colour(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(9)), 80);
  EXPECT_EQ(decode_colour(*jpeg, {640, 480}).error().code, ExitCode::kBadData);
}

TEST(ImageCodec, RefusesALabelWithoutAnInstance) {
  const auto png = encode_labels(some_labels());
  cv::Mat decoded(48, 64, CV_8UC1);
  EXPECT_EQ(decode_labels(*png, 1, decoded).error().code, ExitCode::kBadData);
}

TEST(ImageCodec, RefusesDamagedImagesAndNeverCrashes) {
  constexpr unsigned kSeed = 3;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  const auto png = encode_labels(some_labels());
  const auto jpeg = encode_colour(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(9)), 80);
  cv::Mat decoded(48, 64, CV_8UC1);
  EXPECT_FALSE(decode_labels({}, 2, decoded).has_value());
  EXPECT_FALSE(decode_colour({}, {64, 48}).has_value());
  for (int i = 0; i < 40; ++i) {
    ImageBytes cut(png->begin(),
                   png->begin() + static_cast<std::ptrdiff_t>(random() % png->size()));
    EXPECT_FALSE(decode_labels(cut, 2, decoded).has_value() && cut.size() < png->size() / 2);
    ImageBytes spoilt = *png;
    spoilt[random() % spoilt.size()] ^= static_cast<std::uint8_t>(1U + random() % 255U);
    if (decode_labels(spoilt, 2, decoded)) {
      double largest = 0.0;
      cv::minMaxLoc(decoded, nullptr, &largest);
      EXPECT_LE(largest, 2.0);
    }
    ImageBytes colour = *jpeg;
    colour[random() % colour.size()] ^= static_cast<std::uint8_t>(1U + random() % 255U);
    const auto image = decode_colour(colour, {64, 48});
    EXPECT_TRUE(!image || image->size() == cv::Size(64, 48));
  }
}

}  // namespace
}  // namespace tsg
