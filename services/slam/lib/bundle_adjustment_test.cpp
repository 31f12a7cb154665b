#include "services/slam/lib/bundle_adjustment.hpp"

#include <gtest/gtest.h>

#include <random>

#include "services/slam/lib/reprojection_cost.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

constexpr double kDifference = 1e-6;

const ObservationModel kBundleModel(synthetic::camera(), SlamConfig{});

TEST(ReprojectionCost, DerivativesAgreeWithNumericOnes) {
  std::mt19937 generator(1);
  const SE3 T_camera_world = synthetic::pose_at(0.2, -0.1, 0.3, 0.2);
  const LeftTwistManifold manifold;
  for (const Eigen::Vector3d& point : synthetic::random_points(generator, 20)) {
    const ReprojectionCost cost(kBundleModel, {Eigen::Vector2d(300.0, 200.0), 0.4, 1.25});
    const PoseBlock pose = to_pose_block(T_camera_world);
    const double* parameters[] = {pose.data(), point.data()};
    Eigen::Vector3d residual;
    Eigen::Matrix<double, 3, 7, Eigen::RowMajor> J_pose;
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> J_point;
    double* jacobians[] = {J_pose.data(), J_point.data()};
    ASSERT_TRUE(cost.Evaluate(parameters, residual.data(), jacobians));
    for (int k = 0; k < 6; ++k) {
      Vector6d delta = Vector6d::Zero();
      delta[k] = kDifference;
      PoseBlock moved{};
      ASSERT_TRUE(manifold.Plus(pose.data(), delta.data(), moved.data()));
      const double* moved_parameters[] = {moved.data(), point.data()};
      Eigen::Vector3d there;
      ASSERT_TRUE(cost.Evaluate(moved_parameters, there.data(), nullptr));
      EXPECT_LT(((there - residual) / kDifference - J_pose.col(k)).norm(), 0.01) << "twist " << k;
    }
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d moved = point;
      moved[k] += kDifference;
      const double* moved_parameters[] = {pose.data(), moved.data()};
      Eigen::Vector3d there;
      ASSERT_TRUE(cost.Evaluate(moved_parameters, there.data(), nullptr));
      EXPECT_LT(((there - residual) / kDifference - J_point.col(k)).norm(), 0.01) << "point " << k;
    }
  }
}

TEST(LeftTwistManifold, MinusUndoesPlus) {
  const LeftTwistManifold manifold;
  const PoseBlock pose = to_pose_block(synthetic::pose_at(1.0, 2.0, 3.0, 0.5));
  Vector6d delta;
  delta << 0.1, -0.2, 0.3, 0.05, -0.04, 0.2;
  PoseBlock moved{};
  Vector6d back;
  ASSERT_TRUE(manifold.Plus(pose.data(), delta.data(), moved.data()));
  ASSERT_TRUE(manifold.Minus(moved.data(), pose.data(), back.data()));
  EXPECT_TRUE(back.isApprox(delta, 1e-9));
}

struct NoisyBundle {
  BundleProblem truth;
  BundleProblem noisy;
};

NoisyBundle make_bundle(unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, 0.02);
  NoisyBundle bundle;
  bundle.truth.points = synthetic::random_points(generator, 150);
  for (int i = 0; i < 6; ++i) {
    bundle.truth.cameras.push_back({synthetic::pose_at(0.1 * i, 0.02 * i, 0.0, 0.03 * i), i == 0});
  }
  for (std::size_t c = 0; c < bundle.truth.cameras.size(); ++c) {
    for (std::size_t p = 0; p < bundle.truth.points.size(); ++p) {
      const auto observation =
          synthetic::sighting(bundle.truth.cameras[c].T_camera_world, bundle.truth.points[p]);
      bundle.truth.sightings.push_back({c, p, observation});
    }
  }
  bundle.noisy = bundle.truth;
  for (Eigen::Vector3d& point : bundle.noisy.points) {
    point += Eigen::Vector3d::NullaryExpr([&] { return noise(generator); });
  }
  for (BundleProblem::Camera& camera : bundle.noisy.cameras) {
    const Vector6d twist = Vector6d::NullaryExpr([&] { return noise(generator); });
    if (!camera.fixed) camera.T_camera_world = SE3::exp(twist) * camera.T_camera_world;
  }
  return bundle;
}

TEST(BundleAdjustment, BringsCamerasAndPointsBackToTheTruth) {
  NoisyBundle bundle = make_bundle(2);
  const BundleSummary summary = adjust_bundle(kBundleModel, {.max_iterations = 30}, bundle.noisy);
  ASSERT_TRUE(summary.usable);
  EXPECT_LT(summary.final_cost, 1e-4 * summary.initial_cost);
  for (std::size_t i = 0; i < bundle.truth.cameras.size(); ++i) {
    const SE3 error =
        bundle.noisy.cameras[i].T_camera_world * bundle.truth.cameras[i].T_camera_world.inverse();
    EXPECT_LT(error.log().norm(), 1e-3) << "camera " << i;
  }
}

TEST(BundleAdjustment, KeepsTheGaugeByLeavingFixedCamerasExactlyWhereTheyAre) {
  NoisyBundle bundle = make_bundle(3);
  ASSERT_TRUE(adjust_bundle(kBundleModel, {}, bundle.noisy).usable);
  EXPECT_EQ(bundle.noisy.cameras[0].T_camera_world.translation(),
            bundle.truth.cameras[0].T_camera_world.translation());
  EXPECT_EQ(bundle.noisy.cameras[0].T_camera_world.rotation().coeffs(),
            bundle.truth.cameras[0].T_camera_world.rotation().coeffs());
}

TEST(BundleAdjustment, StopsAfterTheIterationInWhichItIsAskedTo) {
  NoisyBundle bundle = make_bundle(4);
  int asked = 0;
  const BundleLimits limits{.max_iterations = 30, .must_stop = [&asked] { return ++asked >= 2; }};
  const BundleSummary summary = adjust_bundle(kBundleModel, limits, bundle.noisy);
  EXPECT_TRUE(summary.usable);
  EXPECT_EQ(asked, 2);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST(BundleAdjustment, OfTheSameProblemGivesTheSameBits) {
  NoisyBundle first = make_bundle(5);
  NoisyBundle second = make_bundle(5);
  ASSERT_TRUE(adjust_bundle(kBundleModel, {}, first.noisy).usable);
  ASSERT_TRUE(adjust_bundle(kBundleModel, {}, second.noisy).usable);
  for (std::size_t i = 0; i < first.noisy.points.size(); ++i) {
    EXPECT_EQ(first.noisy.points[i], second.noisy.points[i]);
  }
}

TEST(BundleAdjustment, OfNothingIsNotUsable) {
  BundleProblem nothing;
  EXPECT_FALSE(adjust_bundle(kBundleModel, {}, nothing).usable);
}

}  // namespace
}  // namespace tsg
