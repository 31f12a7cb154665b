// What slam tells the map server of keyframes, over the bus.

#include <gtest/gtest.h>

#include "services/slam/keyframe_publisher.hpp"
#include "tests/support/test_bus.hpp"
#include "tests/support/textured_wall.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::seconds kPatience{10};

SE3 moved_to(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, y, z)};
}

TEST(SlamKeyframes, TellsWhereSentKeyframesAreOnceTheMapIsCorrected) {
  TestBus bus;
  TexturedWall wall;
  KeyframePublisher publisher(bus.bus());
  ASSERT_TRUE(bus.watch<topics::Keyframe>(kPatience));
  ASSERT_TRUE(bus.watch<topics::KeyframePoses>(kPatience));
  const RgbdFrame frame = wall.frame(4, 0.0, 0.0);
  const DenseKeyframe keyframe{
      .frame = frame,
      .place = {.T_map_camera = SE3(), .reference = 7, .T_reference_camera = moved_to(0, 0, 0.5)},
      .segmentation = std::nullopt};
  ASSERT_TRUE(publisher.publish(keyframe));
  const auto sent = bus.subscriber<topics::Keyframe>().take({}, kPatience);
  ASSERT_TRUE(sent);

  const std::vector<KeyframePose> corrected = {{.id = 7, .T_world_camera = moved_to(1, 2, 3)}};
  ASSERT_TRUE(publisher.publish_poses(corrected));
  const auto poses = bus.subscriber<topics::KeyframePoses>().take({}, kPatience);
  ASSERT_TRUE(poses);
  ASSERT_EQ((*poses)->keyframes._length, 1U);
  const tsg_KeyframePose& pose = (*poses)->keyframes._buffer[0];
  EXPECT_EQ(pose.id, (*sent)->id);
  EXPECT_EQ(pose.stamp_ns, frame.stamp_ns);
  // The optical axes of the first keyframe, x right, y down, z forward, become those of the map.
  EXPECT_NEAR(pose.T_world_camera.tx, 3.5, 1e-9);
  EXPECT_NEAR(pose.T_world_camera.ty, -1.0, 1e-9);
  EXPECT_NEAR(pose.T_world_camera.tz, -2.0, 1e-9);
}

TEST(SlamKeyframes, LeavesOutWhatItHasNoCorrectionFor) {
  TestBus bus;
  KeyframePublisher publisher(bus.bus());
  ASSERT_TRUE(bus.watch<topics::KeyframePoses>(kPatience));
  ASSERT_TRUE(publisher.publish_poses({}));
  const auto poses = bus.subscriber<topics::KeyframePoses>().take({}, kPatience);
  ASSERT_TRUE(poses);
  EXPECT_EQ((*poses)->keyframes._length, 0U);
}

}  // namespace
}  // namespace tsg::test
