#include "common/simulation/camera/camera_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/core/error.hpp"

namespace tsg::simulation {
namespace {

CameraPathDescription steady_path() {
  CameraPathDescription description;
  description.waypoints = {{.at_s = 0.0, .position_m = {0, 0, 1}, .look_at_m = {2, 0, 1}},
                           {.at_s = 2.0, .position_m = {1, 0, 1}, .look_at_m = {3, 1, 1}},
                           {.at_s = 3.0, .position_m = {1, 1, 1.2}, .look_at_m = {3, 1, 1}}};
  description.tremor_position_m = 0.0;
  description.tremor_rotation_rad = 0.0;
  return description;
}

TEST(CameraPath, PassesItsWaypointsAndLooksWhereTheySay) {
  const CameraPath path = value_or_throw(CameraPath::make(steady_path(), 1));
  for (const CameraWaypoint& waypoint : steady_path().waypoints) {
    const SE3 T_world_camera = path.T_world_camera(waypoint.at_s);
    EXPECT_TRUE(T_world_camera.translation().isApprox(waypoint.position_m, 1e-9));
    const Eigen::Vector3d p_camera = T_world_camera.inverse() * waypoint.look_at_m;
    EXPECT_NEAR(p_camera.head<2>().norm(), 0.0, 1e-9);
    EXPECT_GT(p_camera.z(), 0.0);
  }
}

TEST(CameraPath, RollsAroundTheOpticalAxis) {
  CameraPathDescription description = steady_path();
  description.waypoints.resize(1);
  description.waypoints[0].roll_rad = 0.1;
  const SE3 rolled = value_or_throw(CameraPath::make(description, 1)).T_world_camera(0.0);
  description.waypoints[0].roll_rad = 0.0;
  const SE3 level = value_or_throw(CameraPath::make(description, 1)).T_world_camera(0.0);
  EXPECT_TRUE(
      (level.inverse() * rolled).log().isApprox((Vector6d() << 0, 0, 0, 0, 0, 0.1).finished()));
}

TEST(CameraPath, RestsBeforeAndAfter) {
  const CameraPath path = value_or_throw(CameraPath::make(steady_path(), 1));
  EXPECT_TRUE(path.T_world_camera(-5.0).translation().isApprox(Eigen::Vector3d(0, 0, 1)));
  EXPECT_TRUE(path.T_world_camera(50.0).translation().isApprox(Eigen::Vector3d(1, 1, 1.2)));
}

TEST(CameraPath, MovesWithoutJumps) {
  const CameraPath path = value_or_throw(CameraPath::make(steady_path(), 1));
  double last_speed = 0.0;
  for (double time_s = 0.01; time_s < 3.0; time_s += 0.01) {
    const double speed = (path.T_world_camera(time_s).translation() -
                          path.T_world_camera(time_s - 0.01).translation())
                             .norm() /
                         0.01;
    EXPECT_LT(std::abs(speed - last_speed), 0.1) << time_s;
    last_speed = speed;
  }
}

TEST(CameraPath, TrembleHasTheAskedSizeAndTheSeedsShape) {
  CameraPathDescription description = steady_path();
  description.waypoints.resize(1);
  description.tremor_position_m = 0.002;
  const CameraPath path = value_or_throw(CameraPath::make(description, 1));
  const CameraPath other = value_or_throw(CameraPath::make(description, 2));
  double squares = 0.0;
  double differences = 0.0;
  constexpr int kCount = 3000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3d offset =
        path.T_world_camera(0.02 * i).translation() - Eigen::Vector3d(0, 0, 1);
    squares += offset.squaredNorm() / 3.0;
    differences +=
        (path.T_world_camera(0.02 * i).translation() - other.T_world_camera(0.02 * i).translation())
            .norm();
  }
  EXPECT_NEAR(std::sqrt(squares / kCount), 0.002, 0.0005);
  EXPECT_GT(differences / kCount, 1e-4);
}

TEST(CameraPath, FollowsARecordedTrajectory) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "camera_path_test.txt";
  std::ofstream(file) << "100.0 0 0 1 0 0 0 1\n101.0 1 0 1 0 0 0.70710678 0.70710678\n";
  CameraPathDescription description = steady_path();
  description.waypoints.clear();
  description.trajectory_file = file;
  const CameraPath path = value_or_throw(CameraPath::make(description, 1));
  const SE3 T_world_camera = path.T_world_camera(0.5);
  EXPECT_TRUE(T_world_camera.translation().isApprox(Eigen::Vector3d(0.5, 0, 1), 1e-9));
  EXPECT_NEAR(T_world_camera.angle(), 0.785398, 1e-5);
  EXPECT_TRUE(path.T_world_camera(7.0).translation().isApprox(Eigen::Vector3d(1, 0, 1)));
}

TEST(CameraPath, NeedsSomewhereToBe) {
  const auto path = CameraPath::make({}, 1);
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().code, ExitCode::kBadData);
  CameraPathDescription description;
  description.trajectory_file = "/nowhere/trajectory.txt";
  const auto recorded = CameraPath::make(description, 1);
  ASSERT_FALSE(recorded);
  EXPECT_EQ(recorded.error().code, ExitCode::kMissingInput);
}

}  // namespace
}  // namespace tsg::simulation
