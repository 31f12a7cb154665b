#include "common/dataset/tum_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/shared_dir.hpp"
#include "tests/support/synthetic_sequence.hpp"

namespace tsg {
namespace {

using test::content_of;
using test::is_same_image;
using test::SyntheticSequence;
using test::TempFolder;
using ::testing::HasSubstr;

template <typename T>
void expect_error(const Expected<T>& result, ExitCode code, const std::string& text) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_THAT(result.error().message, HasSubstr(text));
}

/// A sound sequence, for tests to damage.
class TumFolders : public ::testing::Test {
 protected:
  void SetUp() override { sequence_.write_to(folder_); }

  [[nodiscard]] std::string image(const char* kind, int frame) const {
    return (folder_ / kind / (sequence_.stamp_text(frame) + ".png")).string();
  }

  TempFolder folder_;
  SyntheticSequence sequence_;
};

TEST_F(TumFolders, FramesComeByTimeWithTheirPixels) {
  const auto folder = open_tum_folder(folder_.path());
  ASSERT_TRUE(folder) << folder.error().message;
  ASSERT_EQ(folder->frames.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    const auto frame = read_frame(*folder, static_cast<std::size_t>(i));
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->stamp_ns, sequence_.stamp_ns(i));
    EXPECT_EQ(frame->seq, static_cast<std::uint64_t>(i));
    EXPECT_DOUBLE_EQ(frame->camera.fx, 50.0);
    EXPECT_TRUE(is_same_image(frame->colour, sequence_.colour(i)));
    EXPECT_TRUE(is_same_image(frame->depth, sequence_.depth(i)));
  }
}

TEST_F(TumFolders, NamedAsInTheBenchmarkNeedNoCameraFile) {
  std::filesystem::remove(folder_ / "camera.yaml");
  expect_error(open_tum_folder(folder_.path()), ExitCode::kMissingInput, "camera.yaml");
  const std::filesystem::path named = folder_ / "rgbd_dataset_freiburg2_xyz";
  std::filesystem::create_directories(named);
  for (const char* name : {"rgb", "depth", "rgb.txt", "depth.txt"}) {
    std::filesystem::rename(folder_ / name, named / name);
  }
  for (const char* spelling : {"", "/", "/../rgbd_dataset_freiburg2_xyz/."}) {
    const auto folder = open_tum_folder(named.string() + spelling);
    ASSERT_TRUE(folder) << folder.error().message;
    EXPECT_DOUBLE_EQ(folder->camera.model.fx, 520.9);
  }
  folder_.write("rgbd_dataset_freiburg2_xyz/camera.yaml", sequence_.camera_yaml());
  EXPECT_DOUBLE_EQ(value_or_throw(open_tum_folder(named)).camera.model.fx, 50.0);
}

TEST_F(TumFolders, ListsMayBeUnsortedWithCommentsBlankLinesAndRepeats) {
  const auto line = [&](int frame) {
    return sequence_.stamp_text(frame) + " rgb/" + sequence_.stamp_text(frame) + ".png\n";
  };
  folder_.write("rgb.txt", "# c\n\n" + line(3) + "   # c\n" + line(1) + line(3) + "\n" + line(0));
  const auto folder = open_tum_folder(folder_.path());
  ASSERT_TRUE(folder) << folder.error().message;
  ASSERT_EQ(folder->frames.size(), 3U);
  EXPECT_EQ(folder->frames[0].stamp_ns, sequence_.stamp_ns(0));
  EXPECT_EQ(folder->frames[1].stamp_ns, sequence_.stamp_ns(1));
  EXPECT_EQ(folder->frames[2].stamp_ns, sequence_.stamp_ns(3));
}

TEST_F(TumFolders, ImagesFurtherApartThanTheLimitAreNotPaired) {
  const std::string name = " depth/" + sequence_.stamp_text(0) + ".png\n";
  folder_.write("depth.txt", "1700000000.020000" + name + "1700000000.155000" + name);
  const auto folder = open_tum_folder(folder_.path());
  ASSERT_TRUE(folder) << folder.error().message;
  ASSERT_EQ(folder->frames.size(), 1U);  // 33.3 to 20: 13.3 ms; 133.3 to 155: 21.7 ms
  EXPECT_EQ(folder->frames[0].stamp_ns, sequence_.stamp_ns(1));
  EXPECT_EQ(open_tum_folder(folder_.path(), 22'000'000)->frames.size(), 2U);
}

TEST_F(TumFolders, AbsentFolderListOrImageIsNamed) {
  expect_error(open_tum_folder(folder_ / "none"), ExitCode::kMissingInput, "none");
  std::filesystem::remove(image("depth", 2));
  expect_error(open_tum_folder(folder_.path()), ExitCode::kMissingInput, image("depth", 2));
  std::filesystem::remove(folder_ / "depth.txt");
  expect_error(open_tum_folder(folder_.path()), ExitCode::kMissingInput, "depth.txt");
  std::filesystem::remove(folder_ / "rgb.txt");
  expect_error(open_tum_folder(folder_.path()), ExitCode::kMissingInput, "rgb.txt");
}

TEST_F(TumFolders, FolderWithoutCameraFileIsMissingInput) {
  std::filesystem::remove(folder_ / "camera.yaml");
  expect_error(open_tum_folder(folder_.path()), ExitCode::kMissingInput, "camera.yaml");
}

TEST_F(TumFolders, EmptyListAndListsWithoutAPairAreEmptyInput) {
  folder_.write("depth.txt", "1.0 depth/" + sequence_.stamp_text(0) + ".png\n");
  expect_error(open_tum_folder(folder_.path()), ExitCode::kEmptyInput, "within 20 ms");
  folder_.write("rgb.txt", "# nothing\n\n");
  expect_error(open_tum_folder(folder_.path()), ExitCode::kEmptyInput, "rgb.txt");
}

TEST_F(TumFolders, MalformedListLinesAreBadDataAtTheirLine) {
  for (const char* bad : {"1.0\n", "1.0 a.png b.png\n", "one a.png\n", "nan a.png\n"}) {
    folder_.write("rgb.txt", std::string("# c\n") + bad);
    expect_error(open_tum_folder(folder_.path()), ExitCode::kBadData, "rgb.txt:2");
  }
}

TEST_F(TumFolders, DepthOfAnotherSizeThanColourNamesBothFilesAndSizes) {
  cv::imwrite(image("depth", 1), cv::Mat(24, 32, CV_16UC1, cv::Scalar(1)));
  const auto frame = read_frame(*open_tum_folder(folder_.path()), 1);
  expect_error(frame, ExitCode::kSizeMismatch, image("rgb", 1) + " is 64x48");
  expect_error(frame, ExitCode::kSizeMismatch, image("depth", 1) + " is 32x24");
}

TEST_F(TumFolders, ImagesOfAnotherSizeThanTheCameraNameBothFilesAndSizes) {
  folder_.write("camera.yaml", SyntheticSequence{.size = {32, 24}}.camera_yaml());
  const auto frame = read_frame(*open_tum_folder(folder_.path()), 0);
  expect_error(frame, ExitCode::kSizeMismatch, image("rgb", 0) + " is 64x48");
  expect_error(frame, ExitCode::kSizeMismatch, "camera.yaml says 32x24");
}

TEST_F(TumFolders, TruncatedImageIsBadDataAndNamed) {
  const std::string whole = content_of(image("depth", 4));
  folder_.write(image("depth", 4), whole.substr(0, whole.size() / 2));
  const auto folder = open_tum_folder(folder_.path());
  ASSERT_TRUE(folder);
  EXPECT_TRUE(read_frame(*folder, 3));
  expect_error(read_frame(*folder, 4), ExitCode::kBadData, image("depth", 4) + " is truncated");
}

void expect_recorded(const std::string& name, std::size_t frames) {
  TSG_REQUIRE_SHARED("data/" + name);
  const auto path = test::shared_dir() / "data" / name;
  const auto folder = open_tum_folder(path);
  ASSERT_TRUE(folder) << folder.error().message;
  EXPECT_EQ(folder->frames.size(), frames);
  const auto frame = read_frame(*folder, frames - 1);
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->colour.size(), cv::Size(640, 480));
  EXPECT_GT(cv::countNonZero(frame->depth), 100'000);
}

TEST(RecordedSequences, RenderedOneOpens) { expect_recorded("rendered/walking_xyz", 260); }
TEST(RecordedSequences, KinectOneOpens) { expect_recorded("tum_bits/fr1_desk_9", 9); }
TEST(RecordedSequences, SparseOneOpens) { expect_recorded("tum_bits/fr3_cabinet_sub58", 58); }

}  // namespace
}  // namespace tsg
