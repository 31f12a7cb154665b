#include "common/dataset/instance_truth.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/shared_dir.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::TempFolder;
using ::testing::HasSubstr;

constexpr const char* kInstances = R"({"instances": {
  "17": {"cls": "couch", "name": "sofa", "dynamic": false, "frames_visible": 2},
  "205": {"cls": "chair", "name": "dragged", "dynamic": true,
          "moving": {"1.000000": false, "1.033333": true}, "center": {"1.000000": [0, 0, 0]}}},
  "person_cover_per_frame": [0.0, 0.0]})";

void expect_error(const Expected<InstanceTruth>& truth, ExitCode code, const std::string& text) {
  ASSERT_FALSE(truth);
  EXPECT_EQ(truth.error().code, code) << truth.error().message;
  EXPECT_THAT(truth.error().message, HasSubstr(text));
}

class InstanceTruths : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("instances.json", kInstances);
    std::filesystem::create_directories(folder_ / "mask");
    cv::Mat ids(48, 64, CV_8UC1, cv::Scalar(0));
    ids(cv::Rect(10, 5, 20, 8)) = 205;
    ids(cv::Rect(40, 30, 4, 6)) = 17;
    ids(cv::Rect(0, 0, 3, 3)) = 99;  // nothing knows this id
    write_mask("1.000000", ids);
    write_mask("1.033333", ids);
  }
  void write_mask(const std::string& stamp, const cv::Mat& ids) {
    cv::imwrite((folder_ / "mask" / (stamp + ".png")).string(), ids);
  }

  TempFolder folder_;
};

TEST_F(InstanceTruths, InstancesComeWithClassBoxLabelsAndMotion) {
  const auto truth = InstanceTruth::open(folder_.path());
  ASSERT_TRUE(truth) << truth.error().message;
  const auto segmentation = truth->at(1'033'333'000);
  ASSERT_TRUE(segmentation) << segmentation.error().message;
  ASSERT_EQ(segmentation->instances.size(), 2U);
  const Instance& couch = segmentation->instances[0];
  const Instance& chair = segmentation->instances[1];
  EXPECT_EQ(couch.class_name, "couch");
  EXPECT_EQ(couch.motion, MotionVerdict::kStatic);
  EXPECT_EQ(chair.class_name, "chair");
  EXPECT_EQ(chair.motion, MotionVerdict::kMoving);
  EXPECT_EQ(chair.box, cv::Rect2f(10, 5, 20, 8));
  EXPECT_FLOAT_EQ(chair.score, 1.0F);
  EXPECT_EQ(segmentation->labels.at<std::uint8_t>(6, 11), 2);
  EXPECT_EQ(segmentation->labels.at<std::uint8_t>(31, 41), 1);
  EXPECT_EQ(segmentation->labels.at<std::uint8_t>(1, 1), 0);
  EXPECT_EQ(cv::countNonZero(segmentation->labels), 20 * 8 + 4 * 6);
}

TEST_F(InstanceTruths, TellsTheIdsOfTheInstances) {
  const auto truth = InstanceTruth::open(folder_.path());
  ASSERT_TRUE(truth) << truth.error().message;
  const auto mask = truth->mask_at(1'033'333'000);
  ASSERT_TRUE(mask) << mask.error().message;
  EXPECT_EQ(mask->ids, (std::vector<int>{17, 205}));
  EXPECT_EQ(mask->segmentation.instances[1].class_name, "chair");
}

TEST_F(InstanceTruths, ADynamicObjectIsStaticWhileItStands) {
  const auto segmentation = InstanceTruth::open(folder_.path())->at(1'000'000'000);
  ASSERT_TRUE(segmentation);
  EXPECT_EQ(segmentation->instances[1].motion, MotionVerdict::kStatic);
}

TEST_F(InstanceTruths, TheMaskClosestInTimeIsUsedWithinTheLimit) {
  const auto truth = InstanceTruth::open(folder_.path());
  ASSERT_TRUE(truth);
  EXPECT_EQ(truth->at(1'020'000'000)->instances[1].motion, MotionVerdict::kMoving);
  EXPECT_EQ(truth->at(1'020'000'000)->stamp_ns, 1'020'000'000);
  const auto too_late = truth->at(1'060'000'000);
  ASSERT_FALSE(too_late);
  EXPECT_EQ(too_late.error().code, ExitCode::kMissingInput);
  EXPECT_THAT(too_late.error().message, HasSubstr("1.060000"));
}

TEST_F(InstanceTruths, OfTooManyInstancesTheBiggestStay) {
  std::string json = R"({"instances": {)";
  cv::Mat ids(48, 200, CV_16UC1, cv::Scalar(0));
  for (int i = 0; i < 70; ++i) {
    json += (i == 0 ? "\"" : ",\"") + std::to_string(1000 + i) +
            R"(": {"cls": "book", "dynamic": false})";
    ids(cv::Rect(2 * i, 0, 2, i < 6 ? 1 : 3)) = 1000 + i;  // the first six are small
  }
  folder_.write("instances.json", json + "}}");
  write_mask("2.0", ids);
  const auto segmentation = InstanceTruth::open(folder_.path())->at(2'000'000'000);
  ASSERT_TRUE(segmentation) << segmentation.error().message;
  EXPECT_EQ(segmentation->instances.size(), static_cast<std::size_t>(kMaxInstances));
  EXPECT_EQ(segmentation->labels.at<std::uint8_t>(0, 0), 0);
  EXPECT_EQ(segmentation->labels.at<std::uint8_t>(0, 12), 1);
  EXPECT_EQ(segmentation->labels.at<std::uint8_t>(0, 138), 64);
}

TEST_F(InstanceTruths, AbsentPartsAreMissingInput) {
  std::filesystem::remove(folder_ / "instances.json");
  expect_error(InstanceTruth::open(folder_.path()), ExitCode::kMissingInput, "instances.json");
  folder_.write("instances.json", kInstances);
  std::filesystem::remove_all(folder_ / "mask");
  expect_error(InstanceTruth::open(folder_.path()), ExitCode::kMissingInput, "mask");
}

TEST_F(InstanceTruths, FilesThatAreNotWhatTheyShouldBeAreNamed) {
  for (const char* json : {"{", "[]", R"({"instances": {"x": {"cls": "a", "dynamic": true}}})",
                           R"({"instances": {"1": {"dynamic": true}}})"}) {
    folder_.write("instances.json", json);
    expect_error(InstanceTruth::open(folder_.path()), ExitCode::kBadData, "instances.json");
  }
  folder_.write("instances.json", kInstances);
  folder_.write("mask/first.png", "");
  expect_error(InstanceTruth::open(folder_.path()), ExitCode::kBadData, "first.png");
}

TEST_F(InstanceTruths, FolderWithoutMasksIsEmptyInput) {
  std::filesystem::remove_all(folder_ / "mask");
  std::filesystem::create_directory(folder_ / "mask");
  expect_error(InstanceTruth::open(folder_.path()), ExitCode::kEmptyInput, "mask");
}

TEST(RecordedInstances, OfTheMovedChairAreKnownWithTheirMotion) {
  const auto path = test::shared_dir() / "data" / "rendered" / "moved_chair";
  TSG_REQUIRE_SHARED("data/rendered/moved_chair");
  const auto truth = InstanceTruth::open(path);
  ASSERT_TRUE(truth) << truth.error().message;
  EXPECT_EQ(truth->instances().at(205).class_name, "chair");
  EXPECT_TRUE(truth->instances().at(205).is_dynamic);
  const auto first = truth->at(1'700'000'000'000'000'000);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_GT(first->instances.size(), 3U);
  EXPECT_EQ(first->labels.size(), cv::Size(640, 480));
}

}  // namespace
}  // namespace tsg
