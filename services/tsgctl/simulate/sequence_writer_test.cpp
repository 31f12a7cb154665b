#include "services/tsgctl/simulate/sequence_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "common/dataset/instance_truth.hpp"
#include "common/dataset/trajectory.hpp"
#include "common/dataset/tum_folder.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using simulation::SensorDescription;
using simulation::SimulatedFrame;
using simulation::SimulatedInstance;
using test::TempFolder;
using ::testing::HasSubstr;

constexpr int kWidth = 32;
constexpr int kHeight = 24;
constexpr std::int64_t kPeriodNs = 33'333'000;

SensorDescription small_sensor() {
  SensorDescription sensor;
  sensor.camera = sensor.camera.resized(kWidth, kHeight);
  return sensor;
}

/// A frame whose left half is the building and whose right half is one instance.
SimulatedFrame frame_with(int index, int id, const std::vector<int>& moving) {
  SimulatedFrame frame;
  frame.since_start_ns = index * kPeriodNs;
  frame.T_world_camera = SE3(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.1 * index, 0.0, 1.4));
  frame.colour = cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(10, 20, 30 + index));
  frame.depth = cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(5000 + index));
  frame.ids = cv::Mat::zeros(kHeight, kWidth, CV_16UC1);
  frame.ids.colRange(kWidth / 2, kWidth).setTo(id);
  frame.moving = moving;
  return frame;
}

/// Writes two frames: a person who moves in the first only, then a desk.
void write_two_frames(const std::filesystem::path& folder, int person_id) {
  const std::vector<SimulatedInstance> instances{{1, "dining table", "desk_1", false},
                                                 {person_id, "person", "ann", true}};
  auto writer = SequenceWriter::open(folder, small_sensor(), instances);
  ASSERT_TRUE(writer) << writer.error().message;
  ASSERT_TRUE(writer->add(frame_with(0, person_id, {person_id})));
  ASSERT_TRUE(writer->add(frame_with(1, 1, {})));
  ASSERT_TRUE(writer->finish());
}

TEST(SequenceWriter, WritesASequenceThatTheLoaderTakesPixelByPixel) {
  const TempFolder temp;
  write_two_frames(temp / "room", 2);
  const auto folder = open_tum_folder(temp / "room");
  ASSERT_TRUE(folder) << folder.error().message;
  ASSERT_EQ(folder->frames.size(), 2U);
  EXPECT_EQ(folder->camera.model, small_sensor().camera);
  EXPECT_EQ(folder->camera.depth_units_per_metre, 5000.0);
  const auto frame = read_frame(*folder, 1);
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->stamp_ns, kSequenceStartNs + kPeriodNs);
  EXPECT_EQ(frame->colour.at<cv::Vec3b>(3, 3), cv::Vec3b(10, 20, 31));
  EXPECT_EQ(frame->depth.at<std::uint16_t>(3, 3), 5001);
}

TEST(SequenceWriter, WritesThePoses) {
  const TempFolder temp;
  write_two_frames(temp / "room", 2);
  const auto truth = read_ground_truth(temp / "room");
  ASSERT_TRUE(truth) << truth.error().message;
  ASSERT_EQ(truth->size(), 2U);
  EXPECT_EQ(truth->at(1).stamp_ns, kSequenceStartNs + kPeriodNs);
  EXPECT_TRUE(truth->at(1).T_world_camera.translation().isApprox(Eigen::Vector3d(0.1, 0.0, 1.4)));
}

/// Ids of 8 and of 16 bits.
class SequenceWriterMasks : public ::testing::TestWithParam<int> {};

TEST_P(SequenceWriterMasks, SayWhatIsSeenAndWhetherItMoves) {
  const TempFolder temp;
  write_two_frames(temp / "room", GetParam());
  const auto masks = InstanceTruth::open(temp / "room");
  ASSERT_TRUE(masks) << masks.error().message;
  const auto first = masks->at(kSequenceStartNs);
  ASSERT_TRUE(first) << first.error().message;
  ASSERT_EQ(first->instances.size(), 1U);
  EXPECT_EQ(first->instances[0].class_name, "person");
  EXPECT_EQ(first->instances[0].motion, MotionVerdict::kMoving);
  EXPECT_EQ(first->labels.at<std::uint8_t>(3, kWidth - 1), 1);
  EXPECT_EQ(first->labels.at<std::uint8_t>(3, 0), 0);
  const auto second = masks->at(kSequenceStartNs + kPeriodNs);
  ASSERT_EQ(second->instances.size(), 1U);
  EXPECT_EQ(second->instances[0].class_name, "dining table");
  EXPECT_EQ(second->instances[0].motion, MotionVerdict::kStatic);
  EXPECT_EQ(masks->instances().at(GetParam()).moving.at(kSequenceStartNs + kPeriodNs), false);
}

INSTANTIATE_TEST_SUITE_P(Ids, SequenceWriterMasks, ::testing::Values(2, 300));

TEST(SequenceWriter, CountsTheFramesInWhichAnInstanceIsSeen) {
  const TempFolder temp;
  write_two_frames(temp / "room", 2);
  EXPECT_THAT(test::content_of(temp / "room/instances.json"), HasSubstr("\"frames_visible\": 1"));
}

TEST(SequenceWriter, RefusesAFolderWithSomethingInIt) {
  const TempFolder temp;
  temp.write("room/letter.txt", "dear");
  const auto writer = SequenceWriter::open(temp / "room", small_sensor(), {});
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ExitCode::kCannotWrite);
  EXPECT_EQ(writer.error().message,
            (temp / "room").string() +
                " is there already and not an empty folder; remove it, or give another");
}

TEST(SequenceWriter, NamesAFolderThatItCannotMake) {
  const TempFolder temp;
  temp.write("file", "");
  const auto writer = SequenceWriter::open(temp / "file/room", small_sensor(), {});
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ExitCode::kCannotWrite);
  EXPECT_THAT(writer.error().message, HasSubstr((temp / "file/room").string()));
}

}  // namespace
}  // namespace tsg
