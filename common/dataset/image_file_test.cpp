#include "common/dataset/image_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/synthetic_sequence.hpp"

namespace tsg {
namespace {

using test::content_of;
using test::is_same_image;
using test::SyntheticSequence;
using test::TempFolder;
using ::testing::HasSubstr;

const cv::Size kSize{64, 48};

class ImageFiles : public ::testing::Test {
 protected:
  std::string encoded(const std::string& name, const cv::Mat& image) {
    cv::imwrite((folder_ / name).string(), image);
    return content_of(folder_ / name);
  }
  static cv::Mat colour() { return SyntheticSequence{.size = kSize}.colour(3); }
  static cv::Mat depth() { return SyntheticSequence{.size = kSize}.depth(3); }

  /// What goes wrong with a file of this content, at loading or at decoding as colour.
  Expected<void> colour_result(const std::string& name, const std::string& content) {
    const auto file = ImageFile::load(folder_.write(name, content));
    if (!file) return tl::unexpected(file.error());
    return file->decode_colour(cv::Mat(file->size(), CV_8UC3));
  }

  static void expect_error(const Expected<void>& result, ExitCode code, const std::string& text) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
    EXPECT_THAT(result.error().message, HasSubstr(text));
  }

  TempFolder folder_;
};

TEST_F(ImageFiles, PngColourAndDepthAreDecodedIntoTheCallersMemory) {
  encoded("a.png", colour());
  encoded("d.png", depth());
  const cv::Mat bgr(kSize, CV_8UC3);
  const cv::Mat raw_depth(kSize, CV_16UC1);
  const auto colour_file = ImageFile::load(folder_ / "a.png");
  const auto depth_file = ImageFile::load(folder_ / "d.png");
  ASSERT_TRUE(colour_file && depth_file);
  EXPECT_EQ(colour_file->size(), kSize);
  ASSERT_TRUE(colour_file->decode_colour(bgr));
  ASSERT_TRUE(depth_file->decode_depth(raw_depth));
  EXPECT_TRUE(is_same_image(bgr, colour()));
  EXPECT_TRUE(is_same_image(raw_depth, depth()));
}

TEST_F(ImageFiles, JpegIsDecodedAsOpenCvDoes) {
  encoded("a.jpg", colour());
  const cv::Mat bgr(kSize, CV_8UC3);
  const auto file = ImageFile::load(folder_ / "a.jpg");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->size(), kSize);
  ASSERT_TRUE(file->decode_colour(bgr));
  EXPECT_TRUE(is_same_image(bgr, cv::imread((folder_ / "a.jpg").string())));
}

TEST_F(ImageFiles, GreyImagesBecomeColour) {
  for (const char* name : {"g.png", "g.jpg"}) {
    encoded(name, cv::Mat(kSize, CV_8UC1, cv::Scalar(100)));
    const cv::Mat bgr(kSize, CV_8UC3);
    ASSERT_TRUE(ImageFile::load(folder_ / name)->decode_colour(bgr)) << name;
    EXPECT_TRUE(is_same_image(bgr, cv::Mat(kSize, CV_8UC3, cv::Scalar::all(100)))) << name;
  }
}

TEST_F(ImageFiles, PngTruncatedAnywhereIsAnErrorThatNamesTheFile) {
  const std::string whole = encoded("a.png", colour());
  for (std::size_t length = 8; length < whole.size(); length += 31) {
    expect_error(colour_result("cut.png", whole.substr(0, length)), ExitCode::kBadData, "cut.png");
  }
  EXPECT_TRUE(colour_result("cut.png", whole));
}

TEST_F(ImageFiles, JpegTruncatedAnywhereIsAnErrorThatNamesTheFile) {
  const std::string whole = encoded("a.jpg", colour());
  for (std::size_t length = 2; length < whole.size() - 2; length += 31) {
    expect_error(colour_result("cut.jpg", whole.substr(0, length)), ExitCode::kBadData, "cut.jpg");
  }
  EXPECT_TRUE(colour_result("cut.jpg", whole));
}

TEST_F(ImageFiles, PngWithAnyChangedByteIsAnError) {
  const std::string whole = encoded("a.png", colour());
  for (std::size_t i = 8; i < whole.size(); i += 5) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    expect_error(colour_result("bad.png", changed), ExitCode::kBadData, "bad.png");
  }
}

TEST_F(ImageFiles, JpegWithAHoleInItsDataIsAnError) {
  std::string content = encoded("a.jpg", colour());
  std::fill(content.end() - 400, content.end() - 200, '\0');
  expect_error(colour_result("bad.jpg", content), ExitCode::kBadData, "bad.jpg");
}

TEST_F(ImageFiles, WhatIsNoImageIsAnError) {
  expect_error(colour_result("a.png", ""), ExitCode::kBadData, "a.png is empty");
  expect_error(colour_result("a.png", "GIF89a"), ExitCode::kBadData, "neither a PNG nor a JPEG");
}

TEST_F(ImageFiles, AbsentFileIsMissingInput) {
  const auto file = ImageFile::load(folder_ / "no.png");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ExitCode::kMissingInput);
  EXPECT_THAT(file.error().message, HasSubstr("no.png"));
}

TEST_F(ImageFiles, MemoryOfAnotherSizeIsASizeMismatch) {
  encoded("a.png", colour());
  encoded("a.jpg", colour());
  for (const char* name : {"a.png", "a.jpg"}) {
    const auto file = ImageFile::load(folder_ / name);
    ASSERT_TRUE(file);
    expect_error(file->decode_colour(cv::Mat(10, 20, CV_8UC3)), ExitCode::kSizeMismatch,
                 std::string(name) + " is 64x48, expected were 20x10");
  }
}

TEST_F(ImageFiles, DepthMustBeOneChannelOf16Bits) {
  encoded("bits8.png", cv::Mat(kSize, CV_8UC1, cv::Scalar(1)));
  encoded("colour.png", colour());
  encoded("lossy.jpg", colour());
  for (const char* name : {"bits8.png", "colour.png", "lossy.jpg"}) {
    const auto file = ImageFile::load(folder_ / name);
    ASSERT_TRUE(file) << name;
    expect_error(file->decode_depth(cv::Mat(kSize, CV_16UC1)), ExitCode::kBadData, name);
  }
}

TEST_F(ImageFiles, IdsComeFromMasksOf8And16Bits) {
  encoded("m8.png", cv::Mat(kSize, CV_8UC1, cv::Scalar(201)));
  encoded("m16.png", cv::Mat(kSize, CV_16UC1, cv::Scalar(1201)));
  const auto ids8 = ImageFile::load(folder_ / "m8.png")->decode_ids();
  const auto ids16 = ImageFile::load(folder_ / "m16.png")->decode_ids();
  ASSERT_TRUE(ids8 && ids16);
  EXPECT_TRUE(is_same_image(*ids8, cv::Mat(kSize, CV_16UC1, cv::Scalar(201))));
  EXPECT_TRUE(is_same_image(*ids16, cv::Mat(kSize, CV_16UC1, cv::Scalar(1201))));
}

}  // namespace
}  // namespace tsg
