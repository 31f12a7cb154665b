#include "services/slam/lib/triangulation.hpp"

#include <gtest/gtest.h>

#include "services/slam/lib/synthetic_map.hpp"

namespace tsg {
namespace {

using synthetic::pose_at;

PointObservation without_depth(const SE3& T_camera_world, const Eigen::Vector3d& p_world) {
  PointObservation observation = synthetic::sighting(T_camera_world, p_world);
  observation.inverse_depth = 0.0;
  return observation;
}

class Triangulate : public testing::Test {
 protected:
  std::optional<Eigen::Vector3d> see_from(const SE3& T_a_b) {
    const SE3 T_b_a = T_a_b.inverse();
    return triangulate(model_, without_depth(SE3(), p_a_), without_depth(T_b_a, p_a_), T_b_a);
  }
  ObservationModel model_{synthetic::camera(), SlamConfig{}};
  Eigen::Vector3d p_a_{1.0, -0.5, 12.0};
};

TEST_F(Triangulate, FindsThePointThatTwoCamerasSee) {
  const auto found = see_from(pose_at(0.5, 0.1, -0.2, 0.05));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->isApprox(p_a_, 1e-9));
}

TEST_F(Triangulate, SaysNothingWhereTheLinesOfSightAreAlike) {
  EXPECT_FALSE(see_from(pose_at(0.05, 0.0, 0.0)));
  EXPECT_FALSE(see_from(pose_at(0.0, 0.0, 0.0, 0.1))) << "a turn shows no depth";
}

TEST_F(Triangulate, SaysNothingWhereTheTwoSightingsAreNotOfOnePoint) {
  const SE3 T_b_a = pose_at(-0.5, 0.0, 0.0);
  PointObservation off = without_depth(T_b_a, p_a_);
  off.pixel.y() += 8.0;
  EXPECT_FALSE(triangulate(model_, without_depth(SE3(), p_a_), off, T_b_a));
  PointObservation behind = without_depth(T_b_a, p_a_);
  behind.pixel.x() += 60.0;  // the lines of sight part in front of the cameras
  EXPECT_FALSE(triangulate(model_, without_depth(SE3(), p_a_), behind, T_b_a));
}

/// A wall beyond the reach of the depth sensor, and something near that joins the views.
class FarWall : public testing::Test {
 protected:
  static constexpr double kFar = 12.0;
  std::vector<PointId> look_from(const SE3& T_world_second) {
    made_.insert(scene_, SE3(), SE3());
    made_.insert(scene_, T_world_second, T_world_second);
    return add_points_by_triangulation(made_.map, made_.model, made_.config, 1);
  }
  synthetic::HandMadeMap made_;
  synthetic::Scene scene_{
      {{.z = kFar, .corner = {-9.0, -6.0}, .extent = {18.0, 12.0}, .texture_seed = 1},
       {.z = 2.5, .corner = {-0.8, -0.2}, .extent = {1.6, 0.9}, .texture_seed = 2}}};
};

TEST_F(FarWall, BecomesPointsWhereTheCameraMovesAside) {
  const auto added = look_from(pose_at(0.4, 0.0, 0.0));
  EXPECT_GE(added.size(), 50U);
  std::size_t close = 0;
  for (const PointId id : added) {
    const MapPoint& point = *made_.map.find_point(id);
    EXPECT_EQ(point.observations.size(), 2U);
    if (std::abs(point.position.z() - kFar) < 0.1 * kFar) ++close;
  }
  EXPECT_GE(static_cast<double>(close), 0.95 * static_cast<double>(added.size()));
}

TEST_F(FarWall, StaysUnknownWhereTheCameraOnlyTurns) {
  EXPECT_TRUE(look_from(pose_at(0.0, 0.0, 0.0, 0.05)).empty());
}

TEST_F(FarWall, IsNoConcernWhereTheSensorShouldHaveReachedIt) {
  made_.insert(scene_, SE3(), SE3());
  made_.insert(scene_, pose_at(0.4, 0.0, 0.0), pose_at(0.4, 0.0, 0.0));
  SlamConfig config;
  config.features.max_depth_m = 15.0;
  EXPECT_TRUE(add_points_by_triangulation(made_.map, made_.model, config, 1).empty());
}

TEST_F(FarWall, GivesNoPointsTwice) {
  ASSERT_FALSE(look_from(pose_at(0.4, 0.0, 0.0)).empty());
  EXPECT_TRUE(add_points_by_triangulation(made_.map, made_.model, made_.config, 1).empty());
}

}  // namespace
}  // namespace tsg
