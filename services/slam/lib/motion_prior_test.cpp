#include "services/slam/lib/motion_prior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

constexpr double kFrame = 1.0 / 30.0;  // seconds
constexpr double kSpeed = 0.3;         // m/s

/// A millimetre and a milliradian.
Matrix6d usual_covariance() { return 1e-6 * Matrix6d::Identity(); }

PoseEstimate estimate_at(const SE3& T_camera_world) {
  return {.T_camera_world = T_camera_world,
          .is_inlier = {},
          .inliers = 50,
          .covariance = usual_covariance()};
}

SE3 steady(int frame) { return synthetic::pose_at(kSpeed * kFrame * frame, 0.0, 0.0); }

/// Having seen so many frames of a steady motion.
CameraMotion steady_until(int last_frame) {
  CameraMotion motion;
  motion.start(steady(0), usual_covariance());
  for (int frame = 1; frame <= last_frame; ++frame) {
    motion.add(steady(frame), usual_covariance(), kFrame);
  }
  return motion;
}

double metres_between(const SE3& a, const SE3& b) {
  return (a * b.inverse()).log().head<3>().norm();
}

TEST(CameraMotion, GoesOnAsItWent) {
  const PosePrior prior = steady_until(20).predict(kFrame);
  EXPECT_LT(metres_between(prior.T_camera_world, steady(21)), 5e-4);
  EXPECT_TRUE(agrees_with_motion(prior, estimate_at(steady(21))));
}

TEST(CameraMotion, AgreesWithWhatACameraInTheHandCanDo) {
  const PosePrior prior = steady_until(20).predict(kFrame);
  EXPECT_TRUE(agrees_with_motion(
      prior, estimate_at(synthetic::pose_at(0.003, 0.0, 0.0, 0.01) * steady(21))));
}

TEST(CameraMotion, DisagreesWithAJerk) {
  const PosePrior prior = steady_until(20).predict(kFrame);
  EXPECT_FALSE(
      agrees_with_motion(prior, estimate_at(synthetic::pose_at(0.1, 0.0, 0.0) * steady(21))));
  EXPECT_FALSE(
      agrees_with_motion(prior, estimate_at(synthetic::pose_at(0.0, 0.0, 0.0, 0.2) * steady(21))));
}

TEST(CameraMotion, FollowsAJerkThatPosesShow) {
  CameraMotion motion = steady_until(20);
  const SE3 T_jerked = synthetic::pose_at(0.1, 0.0, 0.0);
  for (int frame = 21; frame <= 25; ++frame) {
    motion.add(T_jerked * steady(frame), usual_covariance(), kFrame);
  }
  const PosePrior prior = motion.predict(kFrame);
  EXPECT_TRUE(agrees_with_motion(prior, estimate_at(T_jerked * steady(26))));
}

/// The next step of two such poses would be off by more than twice their error.
TEST(CameraMotion, IsSteadierThanPosesThatScatter) {
  constexpr double kScatter = 0.01;  // metres
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, kScatter);
  CameraMotion motion;
  motion.start(steady(0), kScatter * kScatter * Matrix6d::Identity());
  double squares = 0.0;
  constexpr int kFrames = 300;
  for (int frame = 1; frame <= kFrames; ++frame) {
    const SE3 T_predicted = motion.predict(kFrame).T_camera_world;
    squares += std::pow(metres_between(T_predicted, steady(frame)), 2);
    const SE3 T_off =
        synthetic::pose_at(noise(generator), noise(generator), noise(generator)) * steady(frame);
    motion.add(T_off, kScatter * kScatter * Matrix6d::Identity(), kFrame);
  }
  EXPECT_LT(std::sqrt(squares / (3.0 * kFrames)), kScatter) << "of each axis";
}

TEST(CameraMotion, HoldsLessTheLongerAgoThePoseWas) {
  const CameraMotion motion = steady_until(20);
  const PosePrior soon = motion.predict(kFrame);
  const PosePrior late = motion.predict(10.0 * kFrame);
  for (int i = 0; i < 6; ++i) EXPECT_LT(late.information(i, i), 0.1 * soon.information(i, i));
  const SE3 T_off = synthetic::pose_at(0.1, 0.0, 0.0);
  EXPECT_FALSE(agrees_with_motion(soon, estimate_at(T_off * steady(21))));
  EXPECT_TRUE(agrees_with_motion(late, estimate_at(T_off * steady(30))));
}

TEST(CameraMotion, HoldsLessTheLessThePoseWasKnown) {
  CameraMotion sure;
  CameraMotion unsure;
  sure.start(SE3(), usual_covariance());
  unsure.start(SE3(), 1e6 * usual_covariance());
  const PosePrior held = sure.predict(kFrame);
  const PosePrior loose = unsure.predict(kFrame);
  for (int i = 0; i < 6; ++i) EXPECT_LT(loose.information(i, i), 0.1 * held.information(i, i));
}

TEST(CameraMotion, MovesWithTheWorld) {
  const SE3 T_moved_world = synthetic::pose_at(1.0, -2.0, 0.5, 0.7);
  CameraMotion motion = steady_until(20);
  motion.move_world(T_moved_world);
  const SE3 T_camera_moved = motion.predict(kFrame).T_camera_world;
  EXPECT_LT(metres_between(T_camera_moved * T_moved_world, steady(21)), 5e-4);
}

TEST(CameraMotion, WithoutAPriorThereIsNothingToAgreeWith) {
  EXPECT_FALSE(agrees_with_motion({}, estimate_at(SE3())));
}

}  // namespace
}  // namespace tsg
