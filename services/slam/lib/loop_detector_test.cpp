#include "services/slam/lib/loop_detector.hpp"

#include <gtest/gtest.h>

#include "services/slam/lib/synthetic_map.hpp"

namespace tsg {
namespace {

using synthetic::pose_at;

constexpr double kFar = 20.0;  // metres between two places: they do not see each other

/// A wall 8 m wide around x, and two boards in front of it.
std::vector<synthetic::Panel> place_at(double x, unsigned seed) {
  return {{.z = 3.0, .corner = {x - 4.0, -3.0}, .extent = {8.0, 6.0}, .texture_seed = seed},
          {.z = 2.0, .corner = {x - 0.9, -0.4}, .extent = {0.8, 1.0}, .texture_seed = seed + 1},
          {.z = 1.6, .corner = {x + 0.3, -0.2}, .extent = {0.5, 0.6}, .texture_seed = seed + 2}};
}

/// Two places far apart: the second is not known unless a test makes it like the first.
class LoopDetectorTest : public testing::Test {
 protected:
  void build(const std::vector<synthetic::Panel>& second) {
    std::vector<synthetic::Panel> panels = place_at(0.0, 1);
    panels.insert(panels.end(), second.begin(), second.end());
    scene_.emplace(panels);
  }

  /// Maps what is seen from `T_world_camera` in truth at where drift says that this is.
  void insert(const SE3& T_world_camera, const SE3& T_drifted_world = SE3()) {
    const Keyframe& keyframe =
        made_.insert(*scene_, T_world_camera, T_drifted_world * T_world_camera);
    index_.add(keyframe.id, keyframe.features);
  }

  /// The first place, then a way to between the two, where nothing is to be seen.
  void map_first_place() {
    for (int i = 0; i < 4; ++i) insert(pose_at(0.1 * i, 0.0, 0.0, 0.02 * i));
    for (int i = 0; i < 12; ++i) insert(pose_at(8.0 + 0.3 * i, 0.0, 0.0));
  }

  std::optional<Loop> detect() {
    return detector_.detect(made_.map, index_, made_.map.keyframes().rbegin()->first);
  }

  /// Keyframes that were needed until a loop is told; 0 where none is.
  int keyframes_until_loop(double x, const SE3& T_drifted_world) {
    for (int i = 0; i < 6; ++i) {
      insert(pose_at(x + 0.05 + 0.06 * i, 0.05, 0.1, 0.03), T_drifted_world);
      loop_ = detect();
      if (loop_) return i + 1;
    }
    return 0;
  }

  synthetic::HandMadeMap made_;
  std::optional<synthetic::Scene> scene_;
  PlaceIndex index_{100};
  LoopDetector detector_{made_.model, made_.config};
  std::optional<Loop> loop_;
};

TEST_F(LoopDetectorTest, TellsALoopAfterThreeKeyframesThatAgree) {
  build(place_at(kFar, 50));
  map_first_place();
  const SE3 drift = SE3::exp((Vector6d() << 0.3, 0.1, -0.2, 0.02, 0.05, 0.01).finished());
  EXPECT_EQ(keyframes_until_loop(0.0, drift), 3);
  ASSERT_TRUE(loop_);
  const SE3 truth = pose_at(0.05 + 0.06 * 2, 0.05, 0.1, 0.03);
  EXPECT_LT((loop_->T_world_newest.inverse() * truth).translation().norm(), 0.01);
  EXPECT_LT((loop_->T_world_newest.inverse() * truth).angle(), 0.005);
  EXPECT_LT(loop_->seen_before, 4U);
  const SE3 T_world_before = made_.map.keyframe(loop_->seen_before).T_world_camera;
  EXPECT_LT(((T_world_before * loop_->T_before_newest).inverse() * truth).translation().norm(),
            0.01);
}

TEST_F(LoopDetectorTest, TellsNoneForANewPlace) {
  build(place_at(kFar, 50));
  map_first_place();
  EXPECT_EQ(keyframes_until_loop(kFar, SE3()), 0);
}

TEST_F(LoopDetectorTest, TellsNoneWhereTheSameThingsStandInAnotherOrder) {
  build({{.z = 3.0, .corner = {kFar - 4.6, -2.7}, .extent = {8.0, 6.0}, .texture_seed = 50},
         {.z = 1.7, .corner = {kFar - 0.2, -0.7}, .extent = {0.8, 1.0}, .texture_seed = 2},
         {.z = 2.2, .corner = {kFar - 0.8, -0.2}, .extent = {0.5, 0.6}, .texture_seed = 3}});
  map_first_place();
  EXPECT_EQ(keyframes_until_loop(kFar, pose_at(-kFar, 0.0, 0.0)), 0);
}

TEST_F(LoopDetectorTest, TellsNoneForTheSameThingsInFrontOfAnotherWall) {
  auto copy = place_at(kFar, 1);
  copy[0].z = 4.0;
  copy[0].texture_seed = 50;
  build(copy);
  map_first_place();
  // Drift has brought the copy to where the first one is, so that only the view can tell.
  EXPECT_EQ(keyframes_until_loop(kFar, pose_at(-kFar, 0.0, 0.0)), 0);
}

TEST_F(LoopDetectorTest, TellsNoneForAPerfectCopyFurtherAwayThanThePathCanDrift) {
  build(place_at(kFar, 1));
  map_first_place();
  EXPECT_EQ(keyframes_until_loop(kFar, SE3()), 0);
}

TEST_F(LoopDetectorTest, TakesNoKeyframeNextToItForALoop) {
  build(place_at(kFar, 50));
  for (int i = 0; i < 14; ++i) {
    insert(pose_at(0.04 * i, 0.0, 0.0));
    EXPECT_FALSE(detect()) << "keyframe " << i;
  }
}

TEST_F(LoopDetectorTest, StartsAnewOnceTheMapHasMoved) {
  build(place_at(kFar, 50));
  map_first_place();
  const SE3 drift = pose_at(0.2, 0.0, 0.0);
  for (int i = 0; i < 2; ++i) {
    insert(pose_at(0.05 + 0.06 * i, 0.05, 0.1, 0.03), drift);
    EXPECT_FALSE(detect());
  }
  detector_.reset();
  insert(pose_at(0.2, 0.05, 0.1, 0.03), drift);
  EXPECT_FALSE(detect());
}

}  // namespace
}  // namespace tsg
