#include "common/simulation/people/gait.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/simulation/people/posture.hpp"

namespace tsg::simulation {
namespace {

constexpr double kStepS = 1.0 / 120.0;
constexpr double kHeelM = -0.045;  // ahead of the ankle
constexpr double kBallM = 0.125;

struct WalkCase {
  double speed_mps;
  std::vector<Eigen::Vector2d> corners;
};

class GaitOfAWalk : public ::testing::TestWithParam<WalkCase> {
 protected:
  [[nodiscard]] Posture posture_at(double time_s) const {
    return gait_.at(skeleton_, route_, profile_.along_m(time_s));
  }
  [[nodiscard]] int samples() const { return static_cast<int>(profile_.duration_s() / kStepS); }
  /// Where the sole of a foot is, that far ahead of the ankle: (x, y) of the world, and height.
  [[nodiscard]] Eigen::Vector3d contact(double time_s, Side side, double ahead_m) const {
    const BonePoses bones = solve(skeleton_, posture_at(time_s));
    const FloorPose place = route_.person_at(profile_.along_m(time_s));
    const Eigen::Vector3d ankle = skeleton_.joint(side, LimbBone::kFoot);
    const Eigen::Vector3d sole{ahead_m, ankle.y(), 0.0};
    const Eigen::Vector3d in_person = bones.at(index_of(side, LimbBone::kFoot)) * (sole - ankle);
    const Eigen::Vector2d in_world = moved_by(place, in_person.head<2>());
    return {in_world.x(), in_world.y(), in_person.z()};
  }

  /// The longest way that a place of the sole goes without leaving the floor.
  [[nodiscard]] double longest_slide_m(Side side, double ahead_m) const {
    double longest = 0.0;
    double slid = 0.0;
    Eigen::Vector3d before = contact(0.0, side, ahead_m);
    for (int i = 1; i < samples(); ++i) {
      const Eigen::Vector3d now = contact(kStepS * i, side, ahead_m);
      const bool is_down = now.z() < 0.002 && before.z() < 0.002;
      slid = is_down ? slid + (now - before).head<2>().norm() : 0.0;
      longest = std::max(longest, slid);
      before = now;
    }
    return longest;
  }

  Skeleton skeleton_ = make_skeleton(1.75, 1.0, 1.0);
  Route route_{RoundedPath(GetParam().corners), {}};
  SpeedProfile profile_{route_.length_m(), GetParam().speed_mps};
  Gait gait_{skeleton_, route_, GetParam().speed_mps, true};
};

TEST_P(GaitOfAWalk, FootOnTheFloorDoesNotSlide) {
  for (const Side side : kBothSides) {
    EXPECT_LT(longest_slide_m(side, kHeelM), 0.02) << "heel, side " << index_of(side);
    EXPECT_LT(longest_slide_m(side, kBallM), 0.02) << "ball, side " << index_of(side);
  }
}

TEST_P(GaitOfAWalk, OneFootIsAlwaysOnTheFloorAndNoneBelow) {
  const auto lowest = [this](double time, Side side) {
    return std::min(contact(time, side, kHeelM).z(), contact(time, side, kBallM).z());
  };
  for (int i = 0; i < samples(); ++i) {
    const double time = kStepS * i;
    const double height = std::min(lowest(time, Side::kLeft), lowest(time, Side::kRight));
    ASSERT_NEAR(height, 0.0, 0.012) << "at " << time << " s";
  }
}

TEST_P(GaitOfAWalk, PelvisStaysAtAPlausibleHeight) {
  for (int i = 0; i < samples(); ++i) {
    const double time = kStepS * i;
    const double height =
        solve(skeleton_, posture_at(time))[index_of(Bone::kPelvis)].translation().z();
    ASSERT_GT(height, 0.80) << "at " << time << " s";
    ASSERT_LT(height, 0.96) << "at " << time << " s";
  }
}

TEST_P(GaitOfAWalk, BeginsAndEndsStanding) {
  const Posture standing = standing_posture(skeleton_);
  for (const double time : {0.0, profile_.duration_s()}) {
    const Posture posture = posture_at(time);
    for (const Side side : kBothSides) {
      const std::size_t i = index_of(side);
      EXPECT_LT((posture.feet.at(i).ankle_m - standing.feet.at(i).ankle_m).norm(), 1e-6);
      EXPECT_LT((posture.wrists_m.at(i) - standing.wrists_m.at(i)).norm(), 0.02);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Walks,
                         GaitOfAWalk,
                         ::testing::Values(WalkCase{1.1, {{0, 0}, {6, 0}}},
                                           WalkCase{0.5, {{0, 0}, {2, 0}, {2, 2}}},
                                           WalkCase{1.6, {{0, 0}, {5, 0}, {5, -4}, {1, -4}}},
                                           WalkCase{1.1, {{0, 0}, {0.4, 0}}}));

TEST(RoundedPath, TurnsLittleByLittleAndEndsAtTheLastCorner) {
  const RoundedPath path({{0, 0}, {3, 0}, {3, 3}, {0, 3.5}});
  double before = path.heading_rad(0.0);
  Eigen::Vector2d place = path.position_m(0.0);
  for (int i = 1; 0.01 * i <= path.length_m(); ++i) {
    const double along = 0.01 * i;
    ASSERT_LT(std::abs(path.heading_rad(along) - before), 0.04);
    ASSERT_NEAR((path.position_m(along) - place).norm(), 0.01, 1e-4);
    before = path.heading_rad(along);
    place = path.position_m(along);
  }
  EXPECT_LT((path.position_m(path.length_m()) - Eigen::Vector2d(0, 3.5)).norm(), 1e-9);
}

TEST(SpeedProfile, StartsAndStopsGentlyAndNeverGoesFaster) {
  for (const double length : {0.05, 0.5, 8.0}) {
    const SpeedProfile profile(length, 1.2);
    double before = 0.0;
    for (int i = 1; 0.01 * i < profile.duration_s(); ++i) {
      const double now = profile.along_m(0.01 * i);
      ASSERT_GE(now, before);
      ASSERT_LE((now - before) / 0.01, 1.2001);
      before = now;
    }
    EXPECT_LT(profile.along_m(0.01), 1e-4);
    EXPECT_DOUBLE_EQ(profile.along_m(profile.duration_s()), length);
  }
}

}  // namespace
}  // namespace tsg::simulation
