#include "services/slam/odometry.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

constexpr std::int64_t kBetweenFramesNs = 33'333'333;

SE3 forward(double metres) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, metres)};
}

TrackResult result_at(int frame,
                      KeyframeId reference,
                      const SE3& T_world_reference,
                      const SE3& T_reference_camera) {
  TrackResult result;
  result.stamp_ns = frame * kBetweenFramesNs;
  result.state = TrackingState::kTracking;
  result.reference = reference;
  result.T_reference_camera = T_reference_camera;
  result.T_world_camera = T_world_reference * T_reference_camera;
  return result;
}

void expect_near(const SE3& actual, const SE3& expected) {
  EXPECT_LT((actual.inverse() * expected).log().norm(), 1e-9);
}

TEST(Odometry, ForwardOfTheCameraIsXOfTheMap) {
  Odometry odometry;
  const auto pose = odometry.update(result_at(0, 0, SE3(), forward(2.0)));
  ASSERT_TRUE(pose);
  EXPECT_TRUE(pose->T_map_camera.translation().isApprox(Eigen::Vector3d(2.0, 0.0, 0.0)));
}

TEST(Odometry, UpOfTheCameraIsZOfTheMap) {
  const Eigen::Vector3d above(0.0, -1.0, 0.0);  // y of the image points down
  EXPECT_TRUE((Odometry::T_map_world() * above).isApprox(Eigen::Vector3d::UnitZ()));
}

TEST(Odometry, TurnsTheCovarianceOfTheCameraIntoTheAxesOfOdom) {
  TrackResult result = result_at(0, 0, SE3(), SE3());
  result.covariance.diagonal() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;  // right, down, forward
  const auto pose = Odometry().update(result);
  ASSERT_TRUE(pose);
  Vector6d expected;
  expected << 3.0, 1.0, 2.0, 6.0, 4.0, 5.0;  // forward, left, up
  EXPECT_TRUE(pose->covariance.diagonal().isApprox(expected, 1e-12));
}

TEST(Odometry, DoesNotJumpWhenTheMapIsCorrected) {
  Odometry odometry;
  odometry.update(result_at(0, 0, SE3(), SE3()));
  const auto before = odometry.update(result_at(1, 0, SE3(), forward(0.1)));
  const auto after = odometry.update(result_at(2, 0, forward(5.0), forward(0.2)));
  ASSERT_TRUE(before && after);
  expect_near(before->T_odom_camera.inverse() * after->T_odom_camera, forward(0.1));
  expect_near(after->T_map_odom * after->T_odom_camera, after->T_map_camera);
  EXPECT_NEAR(after->T_map_odom.translation().norm(), 5.0, 1e-9);
}

TEST(Odometry, DoesNotJumpWhenTheReferenceChangesAsTheMapIsCorrected) {
  Odometry odometry;
  const auto before = odometry.update(result_at(0, 0, SE3(), SE3()));
  TrackResult corrected = result_at(1, 7, forward(3.0), forward(0.2));
  corrected.T_previous_camera = forward(0.1);
  const auto after = odometry.update(corrected);
  ASSERT_TRUE(before && after);
  expect_near(before->T_odom_camera.inverse() * after->T_odom_camera, forward(0.1));
  expect_near(after->T_map_odom * after->T_odom_camera, after->T_map_camera);
  EXPECT_NEAR(after->T_map_odom.translation().norm(), 3.1, 1e-9);
}

TEST(Odometry, DoesNotJumpWhenTheCameraIsFoundAgainElsewhere) {
  Odometry odometry;
  const auto before = odometry.update(result_at(0, 0, SE3(), SE3()));
  EXPECT_FALSE(odometry.update(TrackResult{}));
  const auto after = odometry.update(result_at(9, 3, forward(4.0), forward(0.1)));
  ASSERT_TRUE(before && after);
  expect_near(after->T_odom_camera, before->T_odom_camera);
  EXPECT_FALSE(after->twist_camera);
}

TEST(Odometry, GivesTheVelocityInCameraAxes) {
  Odometry odometry;
  odometry.update(result_at(0, 0, SE3(), SE3()));
  const auto pose = odometry.update(result_at(1, 0, SE3(), forward(0.1)));
  ASSERT_TRUE(pose && pose->twist_camera);
  EXPECT_NEAR((*pose->twist_camera)[2], 0.1 / (kBetweenFramesNs * 1e-9), 1e-6);
}

}  // namespace
}  // namespace tsg
