// How exactly the core of slam follows recorded sequences, in lockstep and with masks that come
// late.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/dataset/evaluation.hpp"
#include "services/slam/offline/offline_slam.hpp"
#include "tests/support/shared_dir.hpp"

namespace tsg {
namespace {

using testing::IsEmpty;

std::filesystem::path sequence(const std::string& name) {
  return test::shared_dir() / "data" / name;
}

OfflineRun run(const std::string& name, const OfflineOptions& options = {}) {
  return value_or_throw(open_tum_folder(sequence(name)).and_then([&](const TumFolder& folder) {
    return run_offline(folder, options);
  }));
}

/// ATE RMSE in metres of the corrected trajectory.
double ate_of(const OfflineRun& run, const std::string& name) {
  const Trajectory truth = value_or_throw(read_ground_truth(sequence(name)));
  return value_or_throw(absolute_error(truth, run.corrected)).translation_m.rmse;
}

struct Case {
  std::string name;
  OfflineOptions options;
  double most_ate_m = 0.0;
};

void follow(const Case& expected) {
  const OfflineRun result = run(expected.name, expected.options);
  EXPECT_THAT(result.failures, IsEmpty());
  const double ate_m = ate_of(result, expected.name);
  testing::Test::RecordProperty("ate_m", std::to_string(ate_m));
  EXPECT_LE(ate_m, expected.most_ate_m);
}

TEST(SlamAccuracy, AmongWalkingPeopleWithTrueMasks) {
  TSG_REQUIRE_SHARED("data/rendered/walking_xyz");
  follow({.name = "rendered/walking_xyz", .options = {}, .most_ate_m = 0.004});
}

TEST(SlamAccuracy, AmongWalkingPeopleWithMasksEightFramesLateOfEveryFifthFrame) {
  TSG_REQUIRE_SHARED("data/rendered/walking_xyz");
  OfflineOptions options;
  options.masks.faults.late_frames = 8;
  options.masks.faults.every_frames = 5;
  follow({.name = "rendered/walking_xyz", .options = options, .most_ate_m = 0.01});
}

TEST(SlamAccuracy, AtThreeTimesTheSpeed) {
  TSG_REQUIRE_SHARED("data/rendered/walking_xyz");
  OfflineOptions options;
  options.take_every_frames = 3;
  follow({.name = "rendered/walking_xyz", .options = options, .most_ate_m = 0.005});
}

TEST(SlamAccuracy, RoundAStaticRoom) {
  TSG_REQUIRE_SHARED("data/rendered/static_room");
  follow({.name = "rendered/static_room", .options = {}, .most_ate_m = 0.008});
}

TEST(SlamAccuracy, ClosesALoopWhereTheLocalMapHasForgottenTheStart) {
  TSG_REQUIRE_SHARED("data/rendered/static_room");
  const std::string name = "rendered/static_room";
  OfflineOptions options;
  options.slam.mapper.snapshot_keyframes = 6;
  const OfflineRun result = run(name, options);
  EXPECT_THAT(result.failures, IsEmpty());
  EXPECT_GE(result.map_corrections, 2U) << "pose graph and full adjustment";
  EXPECT_LE(ate_of(result, name), 0.01);
}

TEST(SlamAccuracy, BesideAChairThatIsDragged) {
  TSG_REQUIRE_SHARED("data/rendered/moved_chair");
  follow({.name = "rendered/moved_chair", .options = {}, .most_ate_m = 0.004});
}

TEST(SlamAccuracy, OnRealDistortedImages) {
  TSG_REQUIRE_SHARED("data/tum_bits/fr1_desk_9");
  follow({.name = "tum_bits/fr1_desk_9", .options = {}, .most_ate_m = 0.005});
}

TEST(SlamAccuracy, RoundABareCabinetWithTwoThirdsOfASecondBetweenFrames) {
  TSG_REQUIRE_SHARED("data/tum_bits/fr3_cabinet_sub58");
  const std::string name = "tum_bits/fr3_cabinet_sub58";
  const OfflineRun result = run(name);
  EXPECT_LE(result.failures.size(), 3U) << "of " << result.frames;
  EXPECT_LE(ate_of(result, name), 0.045);
}

TEST(SlamAccuracy, TwoRunsOverTheSameImagesAgreeInEveryBit) {
  TSG_REQUIRE_SHARED("data/tum_bits/fr1_desk_9");
  const OfflineRun first = run("tum_bits/fr1_desk_9");
  const OfflineRun second = run("tum_bits/fr1_desk_9");
  ASSERT_EQ(first.corrected.size(), second.corrected.size());
  for (std::size_t i = 0; i < first.corrected.size(); ++i) {
    const SE3& one = first.corrected[i].T_world_camera;
    const SE3& two = second.corrected[i].T_world_camera;
    EXPECT_EQ(one.translation(), two.translation()) << "frame " << i;
    EXPECT_EQ(one.rotation().coeffs(), two.rotation().coeffs()) << "frame " << i;
  }
}

}  // namespace
}  // namespace tsg
