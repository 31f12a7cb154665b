#include "services/tsgctl/simulate/sequence_writer.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "common/dataset/instance_truth.hpp"
#include "common/dataset/trajectory.hpp"
#include "common/dataset/tum_folder.hpp"
#include "services/tsgctl/simulate/room.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::TempFolder;

constexpr SimulationOptions kSmall{.frames = 3, .width = 64, .height = 48};

TEST(SimulatedSequence, IsASequenceThatTheLoaderTakes) {
  const TempFolder temp;
  write_simulated_sequence(temp.path(), kSmall);
  const auto folder = open_tum_folder(temp.path());
  ASSERT_TRUE(folder.has_value()) << folder.error().message;
  ASSERT_EQ(folder->frames.size(), 3U);
  const auto frame = read_frame(*folder, 2);
  ASSERT_TRUE(frame.has_value()) << frame.error().message;
  EXPECT_EQ(frame->colour.size(), cv::Size(64, 48));
  EXPECT_EQ(cv::countNonZero(frame->depth == 0), 0) << "a closed room has depth everywhere";
}

TEST(SimulatedSequence, HasTrueMasksWithThePersonMoving) {
  const TempFolder temp;
  write_simulated_sequence(temp.path(), {.frames = 90, .width = 64, .height = 48});
  const auto masks = InstanceTruth::open(temp.path());
  ASSERT_TRUE(masks.has_value()) << masks.error().message;
  const auto folder = open_tum_folder(temp.path());
  ASSERT_TRUE(folder.has_value()) << folder.error().message;
  int moving = 0;
  for (const RgbdFiles& frame : folder->frames) {
    const auto seen = masks->at(frame.stamp_ns);
    ASSERT_TRUE(seen.has_value()) << seen.error().message;
    for (const Instance& instance : seen->instances) {
      const bool is_person = instance.class_name == "person";
      EXPECT_EQ(instance.motion == MotionVerdict::kMoving, is_person);
      moving += is_person ? 1 : 0;
    }
  }
  EXPECT_GT(moving, 20) << "somebody walks through the view for a second or so";
}

TEST(SimulatedSequence, DepthAgreesWithThePosesOnAPixelThatBothFramesSee) {
  // A point of the back wall in one view, taken by the poses to the other, has that view's depth.
  CameraModel camera;
  camera.width = 64;
  camera.height = 48;
  camera.fx = camera.fy = 52.0;
  camera.cx = 31.5;
  camera.cy = 23.5;
  const Room room;
  const SE3 T_world_a = Room::T_world_camera(0.0);
  const SE3 T_world_b = Room::T_world_camera(0.5);
  const cv::Mat depth_a = room.render(camera, T_world_a, 0.0).depth;
  const cv::Mat depth_b = room.render(camera, T_world_b, 0.5).depth;
  const double z_a = depth_a.at<std::uint16_t>(10, 32) / kSimulatedDepthUnits;
  const Eigen::Vector3d in_b =
      T_world_b.inverse() * (T_world_a * camera.unproject({32.0, 10.0}, z_a));
  const Eigen::Vector2d pixel = camera.project(in_b);
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  EXPECT_NEAR(depth_b.at<std::uint16_t>(v, u) / kSimulatedDepthUnits, in_b.z(), 0.03);
}

TEST(SimulatedSequence, IsTheSameEachTime) {
  const TempFolder first;
  const TempFolder second;
  write_simulated_sequence(first.path(), kSmall);
  write_simulated_sequence(second.path(), kSmall);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(first.path())) {
    if (!entry.is_regular_file()) continue;
    const auto relative = std::filesystem::relative(entry.path(), first.path());
    EXPECT_EQ(test::content_of(entry.path()), test::content_of(second / relative)) << relative;
  }
}

}  // namespace
}  // namespace tsg
