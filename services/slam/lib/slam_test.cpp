// Tracker and LocalMapper together over rendered scenes with exact poses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/slam/lib/local_mapper.hpp"
#include "services/slam/lib/synthetic_scene.hpp"
#include "services/slam/lib/synthetic_session.hpp"
#include "services/slam/lib/tracker.hpp"

namespace tsg {
namespace {

using synthetic::on_path;
using testing::HasSubstr;

class SlamTest : public testing::Test {
 protected:
  TrackResult step(const RgbdFrame& frame, const InstanceSegmentation* mask = nullptr) {
    const auto features = tracker_.extract(frame, mask);
    TrackResult result = tracker_.track(features, *mapper_.snapshot());
    mapper_.remove_points(result.dynamic_points);
    if (result.keyframe) {
      mapper_.insert(std::move(*result.keyframe));
      mapper_.refine({});
    }
    return result;
  }
  TrackResult step(std::uint64_t seq, const SE3& T_world_camera) {
    return step(scene_.render(seq, T_world_camera));
  }
  static RgbdFrame blank(std::uint64_t seq) {
    RgbdFrame frame = synthetic::Scene({}).render(seq, SE3());
    frame.colour = cv::Scalar::all(100);
    frame.depth = cv::Scalar(10000);
    return frame;
  }

  synthetic::Scene scene_ = synthetic::Scene::room();
  Tracker tracker_{SlamConfig{}, synthetic::camera()};
  LocalMapper mapper_{SlamConfig{}, synthetic::camera()};
};

TEST_F(SlamTest, FollowsAMovingCameraWithinMillimetres) {
  for (int i = 0; i < 25; ++i) {
    const TrackResult result = step(static_cast<std::uint64_t>(i), on_path(i));
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i << ": " << result.reason;
    const SE3 error = on_path(i).inverse() * *result.T_world_camera;
    EXPECT_LT(error.translation().norm(), 0.005) << "frame " << i;
    EXPECT_LT(error.angle(), 0.003) << "frame " << i;
  }
  EXPECT_GE(mapper_.snapshot()->map_keyframes, 3U);
}

TEST_F(SlamTest, GivesTheSameBitsForTheSameInput) {
  Tracker other_tracker(SlamConfig{}, synthetic::camera());
  LocalMapper other_mapper(SlamConfig{}, synthetic::camera());
  for (int i = 0; i < 12; ++i) {
    const RgbdFrame frame = scene_.render(static_cast<std::uint64_t>(i), on_path(i));
    const TrackResult one = step(frame);
    const auto features = other_tracker.extract(frame, nullptr);
    TrackResult two = other_tracker.track(features, *other_mapper.snapshot());
    if (two.keyframe) {
      other_mapper.insert(std::move(*two.keyframe));
      other_mapper.refine({});
    }
    ASSERT_TRUE(one.T_world_camera && two.T_world_camera);
    EXPECT_EQ(one.T_world_camera->translation(), two.T_world_camera->translation());
    EXPECT_EQ(one.T_world_camera->rotation().coeffs(), two.T_world_camera->rotation().coeffs());
  }
}

TEST_F(SlamTest, DoesNotGrowTheMapWhileTheCameraStandsStill) {
  for (int i = 0; i < 6; ++i) step(static_cast<std::uint64_t>(i), on_path(i));
  step(6, on_path(5));  // the last move may still make a keyframe
  const auto before = mapper_.snapshot();
  for (std::uint64_t seq = 7; seq < 20; ++seq) EXPECT_FALSE(step(seq, on_path(5)).keyframe);
  EXPECT_EQ(mapper_.snapshot()->version, before->version);
}

TEST_F(SlamTest, WaitsForAViewWithDepthBeforeItStarts) {
  RgbdFrame frame = scene_.render(0, SE3());
  frame.depth = cv::Scalar(0);
  const TrackResult result = step(frame);
  EXPECT_EQ(result.state, TrackingState::kInitialising);
  EXPECT_FALSE(result.T_world_camera);
  EXPECT_THAT(result.reason, HasSubstr("depth"));
  EXPECT_EQ(step(1, SE3()).state, TrackingState::kTracking);
}

TEST_F(SlamTest, IsLostOnBlankImagesAndFindsItsMapAgain) {
  for (int i = 0; i < 8; ++i) step(static_cast<std::uint64_t>(i), on_path(i));
  for (std::uint64_t seq = 8; seq < 11; ++seq) {
    const TrackResult result = step(blank(seq));
    EXPECT_EQ(result.state, TrackingState::kLost);
    EXPECT_FALSE(result.T_world_camera);
    EXPECT_FALSE(result.reason.empty());
  }
  const SE3 back = synthetic::pose_at(0.05, -0.03, 0.02, -0.05);
  const TrackResult result = step(11, back);
  ASSERT_EQ(result.state, TrackingState::kTracking) << result.reason;
  EXPECT_TRUE(result.relocalised);
  EXPECT_LT((back.inverse() * *result.T_world_camera).translation().norm(), 0.01);
}

/// A walk along a wall until tracking's part of the map no longer holds where it began.
class RelocalisationTest : public SlamTest {
 protected:
  RelocalisationTest() {
    SlamConfig config;
    config.mapper.snapshot_keyframes = 3;
    mapper_ = LocalMapper(config, synthetic::camera());
    scene_.add({.z = 3.0, .corner = {4.0, -3.0}, .extent = {8.0, 6.0}, .texture_seed = 31});
  }
  void walk_away_and_lose() {
    for (; seq_ < 38; ++seq_) {
      const double x = 0.1 * static_cast<double>(seq_);
      ASSERT_TRUE(step(seq_, synthetic::pose_at(x, 0.0, 0.0)).T_world_camera);
    }
    ASSERT_FALSE(step(blank(seq_++)).T_world_camera);
  }
  /// A lost frame, and what mapping recalls by it.
  TrackResult step_and_recall(const synthetic::Scene& scene, const SE3& T_world_camera) {
    const auto features = tracker_.extract(scene.render(seq_++, T_world_camera), nullptr);
    TrackResult result = tracker_.track(features, *mapper_.snapshot());
    if (result.state == TrackingState::kLost) mapper_.recall(*features);
    return result;
  }
  std::uint64_t seq_ = 0;
};

TEST_F(RelocalisationTest, FindsAPlaceThatTheLocalMapHasLeftBehind) {
  walk_away_and_lose();
  const SE3 T_world_camera = synthetic::pose_at(-0.1, 0.1, 0.05, 0.1);
  EXPECT_FALSE(step_and_recall(scene_, T_world_camera).T_world_camera);
  const TrackResult found = step_and_recall(scene_, T_world_camera);
  ASSERT_TRUE(found.T_world_camera) << found.reason;
  EXPECT_TRUE(found.relocalised);
  EXPECT_LT((T_world_camera.inverse() * *found.T_world_camera).translation().norm(), 0.01);
  const SE3 T_world_next = synthetic::pose_at(-0.12, 0.1, 0.05, 0.1);
  const TrackResult next = step_and_recall(scene_, T_world_next);
  ASSERT_TRUE(next.T_world_camera);
  EXPECT_FALSE(next.relocalised);
  EXPECT_LT((T_world_next.inverse() * *next.T_world_camera).translation().norm(), 0.01);
}

TEST_F(RelocalisationTest, StaysLostWhereTheSameThingsStandElsewhere) {
  walk_away_and_lose();
  const synthetic::Scene elsewhere(
      {{.z = 4.5, .corner = {-4.0, -3.0}, .extent = {8.0, 6.0}, .texture_seed = 21},
       {.z = 2.0, .corner = {-0.9, -0.4}, .extent = {0.8, 1.0}, .texture_seed = 2},
       {.z = 1.6, .corner = {0.3, -0.2}, .extent = {0.5, 0.6}, .texture_seed = 3}});
  for (int i = 0; i < 8; ++i) {
    const SE3 T_world_camera = synthetic::pose_at(0.02 * i, 0.0, 0.0);
    EXPECT_FALSE(step_and_recall(elsewhere, T_world_camera).T_world_camera) << "frame " << i;
  }
}

TEST_F(SlamTest, FollowsACameraThatMovesFarBetweenTwoFrames) {
  for (int i = 0; i < 4; ++i) step(static_cast<std::uint64_t>(i), on_path(i));
  const SE3 far = on_path(3) * synthetic::pose_at(-0.3, 0.1, 0.15, 0.15);
  const TrackResult result = step(4, far);
  ASSERT_EQ(result.state, TrackingState::kTracking) << result.reason;
  EXPECT_FALSE(result.relocalised);
  EXPECT_LT((far.inverse() * *result.T_world_camera).translation().norm(), 0.01);
}

TEST_F(SlamTest, KeepsTrackingOnDepthAloneUntilTheFirstSnapshotComes) {
  const LocalMapSnapshot empty;
  for (int i = 0; i < 5; ++i) {
    const RgbdFrame frame = scene_.render(static_cast<std::uint64_t>(i), on_path(i));
    const TrackResult result = tracker_.track(tracker_.extract(frame, nullptr), empty);
    ASSERT_TRUE(result.T_world_camera) << result.reason;
    EXPECT_LT((on_path(i).inverse() * *result.T_world_camera).translation().norm(), 0.01);
    EXPECT_EQ(result.keyframe.has_value(), i == 0);
  }
}

TEST_F(SlamTest, IsNotCarriedAwayByAWalkerInHalfOfTheView) {
  scene_.add(
      {.z = 1.2, .corner = {-0.6, -0.6}, .extent = {0.6, 1.2}, .texture_seed = 9, .label = 1});
  for (int i = 0; i < 15; ++i) {
    scene_.panel(3).corner.x() = -0.6 + 0.03 * i;
    const RgbdFrame frame = scene_.render(static_cast<std::uint64_t>(i), SE3());
    const InstanceSegmentation mask = scene_.mask(frame, SE3(), {"person"});
    const TrackResult result = step(frame, &mask);
    ASSERT_TRUE(result.T_world_camera) << result.reason;
    EXPECT_GT(result.features.dynamic, 50);
    EXPECT_LT(result.T_world_camera->translation().norm(), 0.003) << "frame " << i;
  }
}

TEST_F(SlamTest, TakesOutOfTheMapWhatALateMaskShowsToBeAPerson) {
  scene_.add(
      {.z = 1.2, .corner = {-0.6, -0.6}, .extent = {0.6, 1.2}, .texture_seed = 9, .label = 1});
  const RgbdFrame frame = scene_.render(0, SE3());
  const InstanceSegmentation mask = scene_.mask(frame, SE3(), {"person"});
  step(frame);
  const auto on_person = [](const SnapshotPoint& point) { return point.position.z() < 1.3; };
  const auto before = mapper_.snapshot();
  EXPECT_GT(std::count_if(before->points.begin(), before->points.end(), on_person), 50);
  EXPECT_TRUE(mapper_.apply_mask(mask));
  const auto after = mapper_.snapshot();
  EXPECT_EQ(std::count_if(after->points.begin(), after->points.end(), on_person), 0);
  EXPECT_GT(after->points.size(), before->points.size() / 3);
  InstanceSegmentation of_no_keyframe = mask;
  of_no_keyframe.frame_seq = 77;
  EXPECT_FALSE(mapper_.apply_mask(of_no_keyframe));
}

TEST_F(SlamTest, LeavesTheMapAsItIsWhereMasksHaveNoPartInTheMethod) {
  SlamConfig config;
  config.dynamic_filter.method = DynamicMethod::kNone;
  scene_.add(
      {.z = 1.2, .corner = {-0.6, -0.6}, .extent = {0.6, 1.2}, .texture_seed = 9, .label = 1});
  const RgbdFrame frame = scene_.render(0, SE3());
  const InstanceSegmentation mask = scene_.mask(frame, SE3(), {"person"});
  Tracker tracker(config, synthetic::camera());
  LocalMapper mapper(config, synthetic::camera());
  TrackResult result = tracker.track(tracker.extract(frame, &mask), *mapper.snapshot());
  EXPECT_EQ(result.features.dynamic, 0);
  ASSERT_TRUE(result.keyframe);
  mapper.insert(std::move(*result.keyframe));
  const std::size_t before = mapper.snapshot()->points.size();
  EXPECT_FALSE(mapper.apply_mask(mask));
  EXPECT_EQ(mapper.snapshot()->points.size(), before);
}

TEST_F(SlamTest, ReportsStagesAsTheyBegin) {
  std::vector<TrackingStage> stages;
  Tracker tracker(SlamConfig{}, synthetic::camera(),
                  [&](TrackingStage stage) { stages.push_back(stage); });
  for (int i = 0; i < 2; ++i) {
    const RgbdFrame frame = scene_.render(static_cast<std::uint64_t>(i), on_path(i));
    TrackResult result = tracker.track(tracker.extract(frame, nullptr), *mapper_.snapshot());
    if (result.keyframe) mapper_.insert(std::move(*result.keyframe));
  }
  EXPECT_THAT(stages, testing::ElementsAre(TrackingStage::kMatch, TrackingStage::kOptimise,
                                           TrackingStage::kMatch, TrackingStage::kOptimise,
                                           TrackingStage::kDecide));
}

}  // namespace
}  // namespace tsg
