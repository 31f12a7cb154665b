#include "common/dataset/trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::content_of;
using test::TempFolder;
using ::testing::HasSubstr;

constexpr const char* kPose = "1.5 1 2 3 0 0 0 1\n";

void expect_error(const Expected<Trajectory>& result, ExitCode code, const std::string& text) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, code);
  EXPECT_THAT(result.error().message, HasSubstr(text));
}

TEST(ReadTrajectory, SortsAndSkipsCommentsBlankLinesAndRepeats) {
  const TempFolder folder;
  const auto path = folder.write("t.txt",
                                 "# stamp tx ty tz qx qy qz qw\n\n"
                                 "  2.25 4 5 6 0 0 2 0\r\n"
                                 "\t# indented\n"
                                 "1.5\t1 2 +3 0 0 0 1\n"
                                 "2.25 9 9 9 0 0 0 1\n");
  const auto trajectory = read_trajectory(path);
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  ASSERT_EQ(trajectory->size(), 2U);
  EXPECT_EQ((*trajectory)[0].stamp_ns, 1'500'000'000);
  EXPECT_EQ((*trajectory)[0].T_world_camera.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ((*trajectory)[1].T_world_camera.translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_DOUBLE_EQ((*trajectory)[1].T_world_camera.rotation().z(), 1.0);  // normalised
}

TEST(ReadTrajectory, AbsentFileIsNamed) {
  const TempFolder folder;
  expect_error(read_trajectory(folder / "no.txt"), ExitCode::kMissingInput, "no.txt");
}

TEST(ReadTrajectory, FileWithoutAPoseIsEmptyInput) {
  const TempFolder folder;
  expect_error(read_trajectory(folder.write("t.txt", "# nothing\n")), ExitCode::kEmptyInput,
               "t.txt");
}

TEST(ReadTrajectory, NanAndInfinityAreInvalidNumbersAtTheirLine) {
  const TempFolder folder;
  for (const char* number : {"nan", "NaN", "-nan", "inf", "-inf", "Infinity"}) {
    const std::string bad = std::string("2 0 ") + number + " 0 0 0 0 1\n";
    expect_error(read_trajectory(folder.write("t.txt", kPose + bad)), ExitCode::kInvalidNumber,
                 "t.txt:2");
  }
  expect_error(read_trajectory(folder.write("t.txt", "nan 0 0 0 0 0 0 1\n")),
               ExitCode::kInvalidNumber, "t.txt:1");
}

TEST(ReadTrajectory, MalformedLinesAreBadDataAtTheirLine) {
  const TempFolder folder;
  for (const char* bad :
       {"2 0 0 0 0 0 1\n", "2 0 0 0 0 0 0 1 7\n", "2 0 x 0 0 0 0 1\n", "2 0 0 0 0 0 0 0\n",
        "2 0 0 0 0 0 0 1,0\n", "1403636579763555584 0 0 0 0 0 0 1\n"}) {
    expect_error(read_trajectory(folder.write("t.txt", std::string("# c\n") + kPose + bad)),
                 ExitCode::kBadData, "t.txt:3");
  }
}

TEST(ReadGroundTruth, TakesAFileOrTheGroundTruthOfAFolder) {
  const TempFolder folder;
  const auto path = folder.write("groundtruth.txt", kPose);
  EXPECT_TRUE(read_ground_truth(path));
  EXPECT_TRUE(read_ground_truth(folder.path()));
  const TempFolder empty;
  expect_error(read_ground_truth(empty.path()), ExitCode::kMissingInput, "groundtruth.txt");
}

TEST(WriteTrajectory, ReadsBackAsWritten) {
  const TempFolder folder;
  Vector6d twist;
  twist << 1, -2, 3, 0.3, -0.2, 0.9;
  const Trajectory written{{1'000'000'001, SE3::exp(twist)}, {2'000'000'002, SE3::exp(-twist)}};
  ASSERT_TRUE(write_trajectory(folder / "t.txt", written, StampDecimals::kNanoseconds));
  const auto read = read_trajectory(folder / "t.txt");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ((*read)[i].stamp_ns, written[i].stamp_ns);
    const SE3 T_error = written[i].T_world_camera.inverse() * (*read)[i].T_world_camera;
    EXPECT_LT(T_error.log().norm(), 1e-8);
  }
}

TEST(WriteTrajectory, WritesStampsAsTheTumFilesDoUnlessTold) {
  const TempFolder folder;
  ASSERT_TRUE(write_trajectory(folder / "t.txt", {{1305031453359684000, SE3()}}));
  EXPECT_THAT(content_of(folder / "t.txt"), HasSubstr("\n1305031453.359684 0.000000000 "));
}

TEST(WriteTrajectory, UnwritablePathIsNamedWithTheFix) {
  const TempFolder folder;
  const auto result = write_trajectory(folder / "absent" / "t.txt", {{1, SE3()}});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kCannotWrite);
  EXPECT_THAT(result.error().message, HasSubstr("absent/t.txt"));
}

TEST(WriteTrajectory, FullDiskIsAnError) {
  const auto result = write_trajectory("/dev/full", {{1, SE3()}});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kCannotWrite);
}

TEST(WriteTrajectory, PoseThatIsNotFiniteIsRefusedAndNothingIsWritten) {
  const TempFolder folder;
  const Eigen::Vector3d nowhere(0, std::numeric_limits<double>::quiet_NaN(), 0);
  const auto result =
      write_trajectory(folder / "t.txt", {{1, SE3(Eigen::Quaterniond::Identity(), nowhere)}});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kInvalidNumber);
  EXPECT_FALSE(std::filesystem::exists(folder / "t.txt"));
}

}  // namespace
}  // namespace tsg
