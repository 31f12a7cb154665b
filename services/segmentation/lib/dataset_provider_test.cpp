#include "services/segmentation/lib/dataset_provider.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::TempFolder;
using testing::HasSubstr;

constexpr std::int64_t kStampNs = 1'700'000'000'033'333'000;

/// A folder with one mask: a moving person (id 200) right of a chair (id 7).
class DatasetProviderTest : public testing::Test {
 protected:
  DatasetProviderTest() {
    folder_.write("instances.json", R"({"instances": {
      "7": {"cls": "chair", "name": "chair_0", "dynamic": false},
      "200": {"cls": "person", "name": "walker", "dynamic": true,
              "moving": {"1700000000.033333": true}}}})");
    std::filesystem::create_directory(folder_ / "mask");
    cv::Mat mask(30, 40, CV_8UC1, cv::Scalar(0));
    mask(cv::Rect(2, 3, 10, 20)).setTo(7);
    mask(cv::Rect(20, 0, 15, 30)).setTo(200);
    cv::imwrite(folder_ / "mask/1700000000.033333.png", mask);
  }

  static RgbdFrame frame_at(std::int64_t stamp_ns, cv::Size size = {40, 30}) {
    RgbdFrame frame;
    frame.seq = 5;
    frame.stamp_ns = stamp_ns;
    frame.colour = cv::Mat(size, CV_8UC3, cv::Scalar::all(0));
    return frame;
  }

  /// The error that the provider answers with.
  Error error_for(const RgbdFrame& frame) {
    auto provider = DatasetProvider::make(folder_.path());
    if (!provider) return provider.error();
    cv::Mat labels;
    const auto result = (*provider)->segment(frame, labels);
    return result ? Error{ExitCode::kOk, "no error"} : result.error();
  }

  TempFolder folder_;
};

TEST_F(DatasetProviderTest, GivesTheMaskOfTheFramesStampWithLabelsFromOne) {
  auto provider = DatasetProvider::make(folder_.path());
  ASSERT_TRUE(provider.has_value()) << provider.error().message;
  EXPECT_EQ((*provider)->name(), "dataset");
  cv::Mat labels;
  const auto result = (*provider)->segment(frame_at(kStampNs), labels);
  ASSERT_TRUE(result.has_value()) << result.error().message;
  const InstanceSegmentation& found = result->segmentation;
  EXPECT_EQ(found.frame_seq, 5U);
  EXPECT_EQ(found.stamp_ns, kStampNs);
  ASSERT_EQ(found.instances.size(), 2U);
  EXPECT_EQ(found.instances[0].class_name, "chair");
  EXPECT_EQ(found.instances[1].class_name, "person");
  EXPECT_EQ(found.instances[0].track_id, 7U);
  EXPECT_EQ(found.instances[1].track_id, 200U);
  EXPECT_EQ(found.instances[1].box, cv::Rect2f(20, 0, 15, 30));
  EXPECT_FLOAT_EQ(found.instances[1].score, 1.0F);
  EXPECT_EQ(found.labels.at<std::uint8_t>(10, 5), 1);
  EXPECT_EQ(found.labels.at<std::uint8_t>(10, 25), 2);
  EXPECT_EQ(found.labels.at<std::uint8_t>(0, 0), 0);
}

TEST_F(DatasetProviderTest, DoesNotTellWhoMoves) {
  auto provider = DatasetProvider::make(folder_.path());
  ASSERT_TRUE(provider.has_value());
  cv::Mat labels;
  const auto result = (*provider)->segment(frame_at(kStampNs), labels);
  ASSERT_TRUE(result.has_value());
  for (const Instance& instance : result->segmentation.instances) {
    EXPECT_EQ(instance.motion, MotionVerdict::kUnknown) << instance.class_name;
  }
}

TEST_F(DatasetProviderTest, WithholdsTheMaskOfAnotherFrame) {
  const Error error = error_for(frame_at(kStampNs + 15'000'000));
  EXPECT_EQ(error.code, ExitCode::kMissingInput);
  EXPECT_THAT(error.message, HasSubstr("has no mask for stamp 1700000000.048333"));
}

TEST_F(DatasetProviderTest, WithholdsAMaskOfAnotherSizeThanTheFrame) {
  const Error error = error_for(frame_at(kStampNs, {80, 60}));
  EXPECT_EQ(error.code, ExitCode::kSizeMismatch);
  EXPECT_THAT(error.message, HasSubstr("40x30"));
  EXPECT_THAT(error.message, HasSubstr("80x60"));
}

TEST_F(DatasetProviderTest, WithholdsADamagedMask) {
  folder_.write("mask/1700000000.033333.png", "not a picture");
  EXPECT_EQ(error_for(frame_at(kStampNs)).code, ExitCode::kBadData);
}

TEST_F(DatasetProviderTest, AnswersNoMoreOnceCancelled) {
  auto provider = DatasetProvider::make(folder_.path());
  ASSERT_TRUE(provider.has_value());
  (*provider)->cancel();
  cv::Mat labels;
  EXPECT_FALSE((*provider)->segment(frame_at(kStampNs), labels).has_value());
}

TEST(DatasetProvider, NamesAFolderThatIsNotThere) {
  const auto provider = DatasetProvider::make("/nowhere");
  ASSERT_FALSE(provider.has_value());
  EXPECT_EQ(provider.error().code, ExitCode::kMissingInput);
  EXPECT_THAT(provider.error().message, HasSubstr("/nowhere"));
}

}  // namespace
}  // namespace tsg
