#include "services/slam/lib/motion_prior.hpp"

#include <gtest/gtest.h>

#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

constexpr double kFrame = 1.0 / 30.0;  // seconds

/// A millimetre and a milliradian.
Matrix6d usual_covariance() { return 1e-6 * Matrix6d::Identity(); }

PoseEstimate estimate_at(const SE3& T_camera_world) {
  return {.T_camera_world = T_camera_world,
          .is_inlier = {},
          .inliers = 50,
          .covariance = usual_covariance()};
}

TEST(MotionPrior, AgreesWithWhatACameraInTheHandCanDo) {
  const PosePrior prior = prior_by_motion(SE3(), usual_covariance(), kFrame);
  EXPECT_TRUE(agrees_with_motion(prior, estimate_at(SE3())));
  EXPECT_TRUE(agrees_with_motion(prior, estimate_at(synthetic::pose_at(0.005, 0.0, 0.0, 0.01))));
}

TEST(MotionPrior, DisagreesWithAJerk) {
  const PosePrior prior = prior_by_motion(SE3(), usual_covariance(), kFrame);
  EXPECT_FALSE(agrees_with_motion(prior, estimate_at(synthetic::pose_at(0.1, 0.0, 0.0))));
  EXPECT_FALSE(agrees_with_motion(prior, estimate_at(synthetic::pose_at(0.0, 0.0, 0.0, 0.2))));
}

TEST(MotionPrior, HoldsLessTheLongerAgoThePoseWas) {
  const PosePrior soon = prior_by_motion(SE3(), usual_covariance(), kFrame);
  const PosePrior late = prior_by_motion(SE3(), usual_covariance(), 10.0 * kFrame);
  for (int i = 0; i < 6; ++i) EXPECT_LT(late.information(i, i), 0.01 * soon.information(i, i));
  const PoseEstimate off = estimate_at(synthetic::pose_at(0.1, 0.0, 0.0));
  EXPECT_FALSE(agrees_with_motion(soon, off));
  EXPECT_TRUE(agrees_with_motion(late, off));
}

TEST(MotionPrior, HoldsLessTheLessThePoseWasKnown) {
  const PosePrior sure = prior_by_motion(SE3(), usual_covariance(), kFrame);
  const PosePrior unsure = prior_by_motion(SE3(), 1e4 * usual_covariance(), kFrame);
  for (int i = 0; i < 6; ++i) EXPECT_LT(unsure.information(i, i), 0.1 * sure.information(i, i));
}

TEST(MotionPrior, WithoutOneThereIsNothingToAgreeWith) {
  EXPECT_FALSE(agrees_with_motion({}, estimate_at(SE3())));
}

}  // namespace
}  // namespace tsg
