#include "services/slam/lib/pose_graph.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace tsg {
namespace {

Vector6d random_twist(std::mt19937& generator, double size) {
  std::normal_distribution<double> normal(0.0, size);
  return Vector6d::NullaryExpr([&] { return normal(generator); });
}

TEST(PoseGraph, DerivativeOfTheLogarithmIsRight) {
  std::mt19937 generator(3);
  for (int round = 0; round < 20; ++round) {
    const Vector6d twist = random_twist(generator, 0.3);
    const Matrix66 J = inverse_left_jacobian(twist);
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 6; ++i) {
      const Vector6d step = kStep * Vector6d::Unit(i);
      const Vector6d numeric =
          ((SE3::exp(step) * SE3::exp(twist)).log() - (SE3::exp(-step) * SE3::exp(twist)).log()) /
          (2.0 * kStep);
      EXPECT_LT((J.col(i) - numeric).norm(), 1e-6) << "round " << round;
    }
  }
}

TEST(PoseGraph, AdjointTakesATwistToTheOtherSide) {
  std::mt19937 generator(4);
  const SE3 T_a_b = SE3::exp(random_twist(generator, 1.0));
  const Vector6d twist = random_twist(generator, 0.5);
  const SE3 left = SE3::exp(adjoint(T_a_b) * twist) * T_a_b;
  const SE3 right = T_a_b * SE3::exp(twist);
  EXPECT_LT((left.inverse() * right).log().norm(), 1e-9);
}

/// A round walk of `count` poses, 10 cm apart.
std::vector<SE3> circle(int count) {
  std::vector<SE3> poses;
  const double radius = 0.1 * count / (2.0 * std::numbers::pi);
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    poses.emplace_back(Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())),
                       Eigen::Vector3d(-radius * std::cos(angle), 0.0, radius * std::sin(angle)));
  }
  return poses;
}

/// The walk as odometry with a constant error sees it, with the true closing edge.
PoseGraph drifted(const std::vector<SE3>& truth, const Vector6d& drift_per_step) {
  PoseGraph graph;
  graph.nodes.push_back({truth.front(), true});
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const SE3 T_a_b = truth[i - 1].inverse() * truth[i] * SE3::exp(drift_per_step);
    graph.nodes.push_back({graph.nodes.back().T_world_camera * T_a_b});
    graph.edges.push_back({i - 1, i, T_a_b});
  }
  const std::size_t last = truth.size() - 1;
  graph.edges.push_back({last, 0, truth[last].inverse() * truth[0], 10.0, 10.0});
  return graph;
}

double mean_error(const PoseGraph& graph, const std::vector<SE3>& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += (graph.nodes[i].T_world_camera.translation() - truth[i].translation()).norm();
  }
  return sum / static_cast<double>(truth.size());
}

TEST(PoseGraph, SpreadsTheErrorOfALoopOverTheWay) {
  const std::vector<SE3> truth = circle(200);
  Vector6d drift;
  drift << 2e-4, -1e-4, 5e-4, 1e-4, 4e-4, -2e-4;
  PoseGraph graph = drifted(truth, drift);
  const double before = mean_error(graph, truth);
  const SE3 gap_before = graph.nodes.back().T_world_camera.inverse() * truth.back();
  ASSERT_TRUE(relax(graph));
  EXPECT_GT(gap_before.translation().norm(), 0.2);
  const SE3 gap = graph.nodes.back().T_world_camera.inverse() * truth.back();
  EXPECT_LT(gap.translation().norm(), 0.01);
  EXPECT_LT(mean_error(graph, truth), 0.3 * before);
}

TEST(PoseGraph, LeavesWhatFitsAlready) {
  const std::vector<SE3> truth = circle(40);
  PoseGraph graph = drifted(truth, Vector6d::Zero());
  ASSERT_TRUE(relax(graph));
  EXPECT_LT(mean_error(graph, truth), 1e-9);
}

TEST(PoseGraph, ChangesNothingWhereItIsStopped) {
  const std::vector<SE3> truth = circle(60);
  PoseGraph graph = drifted(truth, Vector6d::Constant(1e-3));
  const double before = mean_error(graph, truth);
  EXPECT_FALSE(relax(graph, [] { return true; }));
  EXPECT_EQ(mean_error(graph, truth), before);
}

TEST(PoseGraph, GivesTheSameBitsForTheSameGraph) {
  const std::vector<SE3> truth = circle(60);
  PoseGraph one = drifted(truth, Vector6d::Constant(1e-3));
  PoseGraph two = one;
  ASSERT_TRUE(relax(one) && relax(two));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(one.nodes[i].T_world_camera.translation(), two.nodes[i].T_world_camera.translation());
  }
}

}  // namespace
}  // namespace tsg
