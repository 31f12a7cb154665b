#include "common/geometry/se3.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace tsg {
namespace {

constexpr int kTrials = 200;

Vector6d random_twist(std::mt19937& generator, double largest_angle) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vector6d twist = Vector6d::NullaryExpr([&] { return uniform(generator); });
  twist.tail<3>() = twist.tail<3>().normalized() * largest_angle * std::abs(uniform(generator));
  return twist;
}

TEST(SE3, LogUndoesExpForAnglesUpToPi) {
  std::mt19937 generator(7);
  for (int i = 0; i < kTrials; ++i) {
    const Vector6d twist = random_twist(generator, std::numbers::pi - 1e-3);
    EXPECT_TRUE(SE3::exp(twist).log().isApprox(twist, 1e-9)) << twist.transpose();
  }
}

TEST(SE3, ExpOfATinyTwistIsFirstOrder) {
  Vector6d twist;
  twist << 1e-9, 2e-9, 3e-9, 4e-9, 5e-9, 6e-9;
  EXPECT_TRUE(SE3::exp(twist).log().isApprox(twist, 1e-6));
}

TEST(SE3, ProductWithInverseIsIdentity) {
  std::mt19937 generator(8);
  for (int i = 0; i < kTrials; ++i) {
    const SE3 T_a_b = SE3::exp(random_twist(generator, 3.0));
    EXPECT_LT((T_a_b * T_a_b.inverse()).log().norm(), 1e-12);
  }
}

TEST(SE3, AgreesWithEigenOnPointsAndProducts) {
  std::mt19937 generator(9);
  const Eigen::Vector3d point(0.3, -2.0, 5.0);
  for (int i = 0; i < kTrials; ++i) {
    const SE3 T_a_b = SE3::exp(random_twist(generator, 3.0));
    const SE3 T_b_c = SE3::exp(random_twist(generator, 3.0));
    const Eigen::Vector3d expected = T_a_b.to_isometry() * T_b_c.to_isometry() * point;
    EXPECT_TRUE((T_a_b * T_b_c * point).isApprox(expected, 1e-12));
  }
}

TEST(SE3, SaysWhenItIsNotFinite) {
  EXPECT_TRUE(SE3().is_finite());
  EXPECT_FALSE(SE3(Eigen::Quaterniond::Identity(),
                   Eigen::Vector3d(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0))
                   .is_finite());
}

TEST(SE3, KeepsEveryBitWhenItIsPutTogetherAgain) {
  std::mt19937 generator(11);
  for (int i = 0; i < kTrials; ++i) {
    const SE3 T_a_b = SE3::exp(random_twist(generator, 3.0));
    const SE3 again = SE3::of_unit_rotation(T_a_b.rotation(), T_a_b.translation());
    EXPECT_EQ(again.rotation().coeffs(), T_a_b.rotation().coeffs());
    EXPECT_EQ(again.translation(), T_a_b.translation());
  }
}

}  // namespace
}  // namespace tsg
