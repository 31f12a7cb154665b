#include "services/slam/lib/trajectory_recorder.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

SE3 shifted(double x) { return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0.0, 0.0)}; }

TrackResult tracked(std::int64_t stamp_ns, KeyframeId reference, double x) {
  TrackResult result;
  result.stamp_ns = stamp_ns;
  result.state = TrackingState::kTracking;
  result.reference = reference;
  result.T_reference_camera = shifted(x);
  result.T_world_camera = shifted(x);
  return result;
}

TEST(TrajectoryRecorder, MovesFramesWithTheirKeyframe) {
  TrajectoryRecorder recorder;
  recorder.record(tracked(10, 0, 0.0));
  recorder.record(tracked(20, 3, 1.0));
  const std::vector<KeyframePose> keyframes = {{0, 0, 10, shifted(0.0)}, {3, 1, 15, shifted(5.0)}};
  const auto corrected = recorder.corrected(keyframes);
  ASSERT_EQ(corrected.size(), 2U);
  EXPECT_EQ(corrected[1].stamp_ns, 20);
  EXPECT_DOUBLE_EQ(corrected[1].T_world_camera.translation().x(), 6.0);
  EXPECT_DOUBLE_EQ(recorder.live(0)[1].T_world_camera.translation().x(), 1.0);
}

TEST(TrajectoryRecorder, CountsLostFramesAfterTheFirstPoseOnly) {
  TrajectoryRecorder recorder;
  recorder.record(TrackResult{});
  recorder.record(tracked(10, 0, 0.0));
  TrackResult lost;
  lost.state = TrackingState::kLost;
  recorder.record(lost);
  EXPECT_EQ(recorder.tracked(), 1U);
  EXPECT_EQ(recorder.lost(), 1U);
}

TEST(TrajectoryRecorder, LeavesOutFramesWhoseKeyframeIsUnknown) {
  TrajectoryRecorder recorder;
  recorder.record(tracked(10, 7, 0.0));
  EXPECT_TRUE(recorder.corrected({{0, 0, 10, shifted(0.0)}}).empty());
}

}  // namespace
}  // namespace tsg
