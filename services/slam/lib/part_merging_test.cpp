#include "services/slam/lib/part_merging.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/slam/lib/local_mapper.hpp"
#include "services/slam/lib/synthetic_map.hpp"
#include "services/slam/lib/synthetic_scene.hpp"
#include "services/slam/lib/tracker.hpp"
#include "services/slam/lib/trajectory_recorder.hpp"

namespace tsg {
namespace {

using synthetic::pose_at;
using testing::Each;
using testing::Field;
using testing::Gt;
using testing::HasSubstr;

TEST(MergePart, MovesOnePartWithItsPointsAndLeavesTheOtherAlone) {
  const synthetic::Scene scene = synthetic::Scene::room();
  synthetic::HandMadeMap made;
  made.insert(scene, SE3(), SE3());
  made.insert(scene, pose_at(0.1, 0.0, 0.0), SE3());
  Map& map = made.map;
  map.find_keyframe(1)->part = 1;
  const auto point_of = [&](KeyframeId id) {
    return map.find_point(*std::ranges::find_if(map.keyframe(id).points, [&](PointId point) {
      return point != kNoPoint && map.find_point(point)->observations.size() == 1;
    }));
  };
  const Eigen::Vector3d of_first = point_of(0)->position;
  const Eigen::Vector3d of_second = point_of(1)->position;
  const SE3 T_into_from = pose_at(0.1, 0.2, 0.3, 0.4);

  merge_part(map, ObservationModel(synthetic::camera(), SlamConfig{}), 1, 0, T_into_from);

  EXPECT_EQ(map.keyframe(1).part, 0U);
  EXPECT_TRUE(
      map.keyframe(1).T_world_camera.translation().isApprox(T_into_from.translation(), 1e-12));
  EXPECT_TRUE(point_of(1)->position.isApprox(T_into_from * of_second, 1e-12));
  EXPECT_TRUE(map.keyframe(0).T_world_camera.translation().isZero());
  EXPECT_EQ(point_of(0)->position, of_first);
}

/// A camera that walks along two walls side by side, one step of 10 cm a frame, and is blind now
/// and then. The world of truth is where it starts.
class PartsTest : public testing::Test {
 protected:
  explicit PartsTest(const SlamConfig& config = {})
      : tracker_(config, synthetic::camera()), mapper_(config, synthetic::camera()) {
    scene_.add({.z = 3.0, .corner = {4.0, -3.0}, .extent = {8.0, 6.0}, .texture_seed = 31});
  }

  TrackResult see(const RgbdFrame& frame) {
    const auto features = tracker_.extract(frame, nullptr);
    TrackResult result = tracker_.track(features, *mapper_.snapshot());
    recorder_.record(result);
    if (result.state == TrackingState::kLost) mapper_.recall(*features);
    if (result.keyframe) {
      mapper_.insert(std::move(*result.keyframe));
      mapper_.refine({});
      while (mapper_.is_adjusting()) mapper_.adjust({});
    }
    return result;
  }
  TrackResult see_from(double x) {
    x_of_[seq_] = x;
    return see(scene_.render(seq_++, pose_at(x, 0.0, 0.0)));
  }
  TrackResult see_nothing() {
    RgbdFrame frame = synthetic::Scene({}).render(seq_++, SE3());
    frame.depth = cv::Scalar(0);
    return see(frame);
  }
  /// As long as it takes to give up.
  void be_blind_for_long() {
    EXPECT_EQ(see_nothing().state, TrackingState::kLost);
    seq_ += 100;
    const TrackResult result = see_nothing();
    EXPECT_EQ(result.state, TrackingState::kLost) << "there is nothing to begin a part with";
    EXPECT_THAT(result.reason, HasSubstr("neither"));
  }
  void walk(double from, double to) {
    const double step = from < to ? 0.1 : -0.1;
    const auto steps = static_cast<int>(std::lround((to - from) / step));
    for (int i = 0; i <= steps; ++i) last_ = see_from(from + i * step);
  }
  /// How far the camera is from where it should be relative to the place at `x_origin`.
  double error_m(const SE3& T_world_camera, std::uint64_t seq, double x_origin) {
    return (T_world_camera.translation() - Eigen::Vector3d(x_of_.at(seq) - x_origin, 0.0, 0.0))
        .norm();
  }

  synthetic::Scene scene_ = synthetic::Scene::room();
  Tracker tracker_;
  LocalMapper mapper_;
  TrajectoryRecorder recorder_;
  std::uint64_t seq_ = 0;
  std::map<std::uint64_t, double> x_of_;
  TrackResult last_;
};

TEST_F(PartsTest, BeginsANewPartWhereNothingIsKnownAndMergesItWithTheOldOneWhenThatIsSeen) {
  walk(0.0, 3.7);
  ASSERT_GE(mapper_.snapshot()->map_keyframes, 10U);
  be_blind_for_long();

  const TrackResult elsewhere = see_from(8.0);
  ASSERT_EQ(elsewhere.state, TrackingState::kTracking) << elsewhere.reason;
  EXPECT_NE(elsewhere.part, 0U);
  EXPECT_TRUE(elsewhere.relocalised);
  EXPECT_TRUE(elsewhere.reason.empty());
  EXPECT_TRUE(elsewhere.T_world_camera->translation().isZero()) << "a world of its own";
  EXPECT_EQ(mapper_.snapshot()->part, elsewhere.part);
  EXPECT_EQ(mapper_.snapshot()->main_part, 0U) << "what is worth keeping stays the map";
  EXPECT_EQ(recorder_.longest_part(mapper_.keyframe_poses()), 0U);

  for (double x = 7.9; x > 2.5; x -= 0.1) {
    const TrackResult result = see_from(x);
    ASSERT_TRUE(result.T_world_camera) << "at " << x << ": " << result.reason;
    ASSERT_TRUE(result.T_previous_camera) << "odometry goes on, merged or not";
    EXPECT_NEAR(result.T_previous_camera->translation().x(), -0.1, 0.01) << "at " << x;
    last_ = result;
  }
  EXPECT_EQ(last_.part, 0U);
  EXPECT_LT(error_m(*last_.T_world_camera, last_.seq, 0.0), 0.03);
  const auto poses = mapper_.keyframe_poses();
  EXPECT_THAT(poses, Each(Field(&KeyframePose::part, 0U)));
  for (const KeyframePose& pose : poses) {
    EXPECT_LT(error_m(pose.T_world_camera, pose.seq, 0.0), 0.03) << "keyframe " << pose.id;
  }
  EXPECT_EQ(recorder_.corrected(poses).size(), recorder_.tracked()) << "all in one world now";
}

TEST_F(PartsTest, APartThatWasLostEarlyGivesWayAndJoinsTheNextOneLater) {
  walk(0.0, 0.4);
  be_blind_for_long();
  const MapPart next = see_from(6.0).part;
  EXPECT_NE(next, 0U);
  EXPECT_EQ(mapper_.snapshot()->main_part, next);

  walk(5.9, -0.4);
  ASSERT_TRUE(last_.T_world_camera) << last_.reason;
  EXPECT_EQ(last_.part, next);
  const auto poses = mapper_.keyframe_poses();
  EXPECT_THAT(poses, Each(Field(&KeyframePose::part, next)));
  for (const KeyframePose& pose : poses) {
    EXPECT_LT(error_m(pose.T_world_camera, pose.seq, 6.0), 0.04) << "keyframe " << pose.id;
  }
}

TEST_F(PartsTest, FindsTheOldPartAgainFromTheNewOne) {
  walk(0.0, 3.7);
  be_blind_for_long();
  walk(8.0, 8.5);
  EXPECT_NE(last_.part, 0U);
  see_nothing();
  see_from(1.0);  // mapping recalls the place
  const TrackResult back = see_from(1.0);
  ASSERT_TRUE(back.T_world_camera) << back.reason;
  EXPECT_EQ(back.part, 0U);
  EXPECT_LT(error_m(*back.T_world_camera, back.seq, 0.0), 0.01);
  const Trajectory corrected = recorder_.corrected(mapper_.keyframe_poses());
  EXPECT_EQ(corrected.size(), 38U + 1U) << "the frames of the other part have no place in it";
}

SlamConfig without_parts() {
  SlamConfig config;
  config.tracker.new_part_after_s = 0.0;
  return config;
}
class NoPartsTest : public PartsTest {
 protected:
  NoPartsTest() : PartsTest(without_parts()) {}
};

TEST_F(NoPartsTest, StaysLostWherePartsAreSwitchedOff) {
  walk(0.0, 1.0);
  be_blind_for_long();
  EXPECT_EQ(see_from(8.0).state, TrackingState::kLost);
}

}  // namespace
}  // namespace tsg
