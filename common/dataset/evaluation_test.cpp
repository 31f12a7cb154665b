#include "common/dataset/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>

#include "tests/support/shared_dir.hpp"

namespace tsg {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kPeriodNs = 33'333'333;

SE3 make_pose(double x, double y, double z, double yaw_rad = 0.0) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())),
          Eigen::Vector3d(x, y, z)};
}

/// A bent path without any symmetry.
Trajectory make_path(std::size_t count) {
  Trajectory path;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    path.push_back({static_cast<std::int64_t>(i) * kPeriodNs,
                    make_pose(std::sin(t), 0.3 * t * t, std::cos(0.7 * t), 0.2 * t)});
  }
  return path;
}

Trajectory with_noise(Trajectory trajectory, double sigma_m) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, sigma_m);
  for (StampedPose& pose : trajectory) {
    pose.T_world_camera =
        make_pose(noise(random), noise(random), noise(random), noise(random)) * pose.T_world_camera;
  }
  return trajectory;
}

Trajectory moved(const SE3& T_other_world, Trajectory trajectory) {
  for (StampedPose& pose : trajectory) pose.T_world_camera = T_other_world * pose.T_world_camera;
  return trajectory;
}

TEST(AbsoluteError, OfAPerfectEstimateIsZero) {
  const auto error = absolute_error(make_path(50), make_path(50));
  ASSERT_TRUE(error);
  EXPECT_EQ(error->translation_m.count, 50U);
  EXPECT_LT(error->translation_m.max, 1e-12);
}

TEST(AbsoluteError, DoesNotDependOnTheFrameOfTheEstimate) {
  const Trajectory truth = make_path(50);
  const Trajectory estimate = with_noise(truth, 0.02);
  const SE3 T_other_world(Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2), Eigen::Vector3d(3, -8, 2));
  const auto here = absolute_error(truth, estimate);
  const auto there = absolute_error(truth, moved(T_other_world, estimate));
  ASSERT_TRUE(here && there);
  EXPECT_GT(here->translation_m.rmse, 0.005);
  EXPECT_NEAR(here->translation_m.rmse, there->translation_m.rmse, 1e-9);
  EXPECT_NEAR(here->translation_m.max, there->translation_m.max, 1e-9);
}

TEST(AbsoluteError, AlignsWithoutScale) {
  // A square of side 2 seen as one of side 1: centred, every corner is off by half a diagonal.
  const Trajectory truth{{0, make_pose(1, 1, 0)},
                         {kPeriodNs, make_pose(-1, 1, 0)},
                         {2 * kPeriodNs, make_pose(-1, -1, 0)},
                         {3 * kPeriodNs, make_pose(1, -1, 0)}};
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) {
    pose.T_world_camera = SE3(pose.T_world_camera.rotation(),
                              Eigen::Vector3d(0.5 * pose.T_world_camera.translation()));
  }
  const auto error = absolute_error(truth, estimate);
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->translation_m.rmse, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(error->translation_m.std_dev, 0.0, 1e-12);
}

TEST(AbsoluteError, ListsTheErrorOfEveryMatchedPose) {
  const Trajectory truth = make_path(30);
  const auto error = absolute_error(truth, with_noise(truth, 0.02));
  ASSERT_TRUE(error);
  ASSERT_EQ(error->errors_m.size(), error->matched.size());
  const MatchedPose& pose = error->matched[7];
  const SE3 T_world_camera = error->T_world_estimate * pose.T_estimate_camera;
  EXPECT_NEAR((T_world_camera.translation() - pose.T_world_truth.translation()).norm(),
              error->errors_m[7], 1e-12);
}

TEST(AbsoluteError, TooFewPairsIsEmptyInputWithTheFix) {
  Trajectory late = make_path(50);
  for (StampedPose& pose : late) pose.stamp_ns += 1'000'000'000'000;
  const auto error = absolute_error(make_path(50), late);
  ASSERT_FALSE(error);
  EXPECT_EQ(error.error().code, ExitCode::kEmptyInput);
  EXPECT_THAT(error.error().message, HasSubstr("only 0 poses"));
  EXPECT_THAT(error.error().message, HasSubstr("same recording"));
}

TEST(RelativeError, AgreesWithFiguresWorkedOutByHand) {
  // Truth: 1 m forward a frame. Estimate: 1.1 m, then 1 m with a turn of 10 degrees, then 1 m along
  // the new heading: relative errors 0.1 m; 0 m and 10 degrees; 0 m.
  const double turn_rad = 10.0 * std::numbers::pi / 180.0;
  const Trajectory truth{{0, make_pose(0, 0, 0)},
                         {kPeriodNs, make_pose(1, 0, 0)},
                         {2 * kPeriodNs, make_pose(2, 0, 0)},
                         {3 * kPeriodNs, make_pose(3, 0, 0)}};
  const SE3 T_turned = make_pose(2.1, 0, 0, turn_rad);
  const Trajectory estimate{{0, make_pose(0, 0, 0)},
                            {kPeriodNs, make_pose(1.1, 0, 0)},
                            {2 * kPeriodNs, T_turned},
                            {3 * kPeriodNs, T_turned * make_pose(1, 0, 0)}};
  const auto error = relative_error(truth, estimate, {.delta = 1, .unit = DeltaUnit::kFrames});
  ASSERT_TRUE(error);
  EXPECT_EQ(error->translation_m.count, 3U);
  EXPECT_NEAR(error->translation_m.max, 0.1, 1e-12);
  EXPECT_NEAR(error->translation_m.rmse, std::sqrt(0.01 / 3.0), 1e-12);
  EXPECT_NEAR(error->rotation_deg.mean, 10.0 / 3.0, 1e-9);
  // Over two frames the first pair is off by 0.1 m and 10 degrees; the second sees the turn first
  // and so ends where a chord of 1 m turned by 10 degrees ends.
  const auto two = relative_error(truth, estimate, {.delta = 2, .unit = DeltaUnit::kFrames});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->translation_m.count, 2U);
  EXPECT_NEAR(two->translation_m.min, 0.1, 1e-12);
  EXPECT_NEAR(two->translation_m.max, 2.0 * std::sin(turn_rad / 2.0), 1e-12);
}

TEST(RelativeError, OverSecondsTakesThePoseClosestToThatTime) {
  // 30 Hz: half a second is 15 frames.
  const Trajectory truth = make_path(60);
  const Trajectory estimate = with_noise(truth, 0.02);
  const auto seconds = relative_error(truth, estimate, {.delta = 0.5});
  const auto frames = relative_error(truth, estimate, {.delta = 15, .unit = DeltaUnit::kFrames});
  ASSERT_TRUE(seconds && frames);
  EXPECT_EQ(seconds->translation_m.count, 45U);
  EXPECT_DOUBLE_EQ(seconds->translation_m.rmse, frames->translation_m.rmse);
}

TEST(RelativeError, OverSecondsSkipsGapsInsteadOfTakingAPoseFarOff) {
  Trajectory truth = make_path(60);
  truth.erase(truth.begin() + 20, truth.begin() + 40);
  const auto error = relative_error(truth, truth, {.delta = 0.5});
  ASSERT_TRUE(error);
  // Partners at i + 15 exist for i = 0..4 (frames to 19), 25..39 are gone, 5..19 fall into the
  // gap, 40..44 have theirs.
  EXPECT_EQ(error->translation_m.count, 10U);
}

TEST(RelativeError, DoesNotDependOnTheFrameOfTheEstimate) {
  const Trajectory truth = make_path(60);
  const Trajectory estimate = with_noise(truth, 0.02);
  const SE3 T_other_world(Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2), Eigen::Vector3d(3, -8, 2));
  const auto here = relative_error(truth, estimate, {});
  const auto there = relative_error(truth, moved(T_other_world, estimate), {});
  ASSERT_TRUE(here && there);
  EXPECT_NEAR(here->translation_m.rmse, there->translation_m.rmse, 1e-9);
  EXPECT_NEAR(here->rotation_deg.rmse, there->rotation_deg.rmse, 1e-6);
}

TEST(RelativeError, RefusesADeltaThatIsNone) {
  for (const double delta : {0.0, -1.0, 1e300, std::nan("")}) {
    const auto error = relative_error(make_path(9), make_path(9), {.delta = delta});
    ASSERT_FALSE(error);
    EXPECT_EQ(error.error().code, ExitCode::kUsage);
  }
  const auto error =
      relative_error(make_path(9), make_path(9), {.delta = 1.5, .unit = DeltaUnit::kFrames});
  ASSERT_FALSE(error);
  EXPECT_EQ(error.error().code, ExitCode::kUsage);
}

TEST(RelativeError, DeltaLongerThanTheTrajectoryIsEmptyInput) {
  const auto error = relative_error(make_path(9), make_path(9), {.delta = 60.0});
  ASSERT_FALSE(error);
  EXPECT_EQ(error.error().code, ExitCode::kEmptyInput);
}

TEST(ImprovementRate, IsThePapersFigureForFr3WalkingStatic) {
  EXPECT_NEAR(improvement_rate(0.0367, 0.0094), 0.7439, 1e-4);
  EXPECT_LT(improvement_rate(1.0, 1.1), 0.0);
}

/// Published estimates with their truth: what other evaluators say must come out.
void expect_published_error(const char* truth_name,
                            const char* estimate_name,
                            double rmse_m,
                            std::size_t pairs) {
  const std::filesystem::path folder = test::shared_dir() / "data" / "traj";
  TSG_REQUIRE_SHARED("data/traj");
  const auto truth = read_trajectory(folder / truth_name);
  const auto estimate = read_trajectory(folder / estimate_name);
  ASSERT_TRUE(truth) << truth.error().message;
  ASSERT_TRUE(estimate) << estimate.error().message;
  const auto error = absolute_error(*truth, *estimate);
  ASSERT_TRUE(error) << error.error().message;
  EXPECT_EQ(error->translation_m.count, pairs);
  EXPECT_NEAR(error->translation_m.rmse, rmse_m, 1e-6);
}

TEST(PublishedTrajectories, Fr1XyzByRgbdSlamHasItsPublishedError) {
  expect_published_error("freiburg1_xyz-groundtruth.txt", "freiburg1_xyz-rgbdslam.txt", 0.013473,
                         786);
}

TEST(PublishedTrajectories, Fr2DeskByOrbSlamHasItsPublishedError) {
  expect_published_error("fr2_desk_groundtruth.txt", "fr2_desk_ORB.txt", 0.008144, 2223);
}

}  // namespace
}  // namespace tsg
