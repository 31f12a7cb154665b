#include "services/slam/lib/loop_closer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "services/slam/lib/synthetic_map.hpp"

namespace tsg {
namespace {

using synthetic::pose_at;

constexpr double kStride = 0.5;  // metres between keyframes

/// A way along a wall, once round a rectangle of 5 m x 4 m, and a bit of the same again. Views that
/// are not neighbours have nothing in common, until the way closes.
std::vector<SE3> way_round() {
  std::vector<SE3> poses;
  const auto walk = [&poses](double dx, double dy, int steps) {
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector3d at =
          poses.empty() ? Eigen::Vector3d::Zero().eval()
                        : (poses.back().translation() + Eigen::Vector3d(dx, dy, 0.0)).eval();
      poses.push_back(pose_at(at.x(), at.y(), at.z()));
    }
  };
  walk(kStride, 0.0, 11);
  walk(0.0, -kStride, 8);
  walk(-kStride, 0.0, 10);
  walk(0.0, kStride, 8);
  walk(0.1, 0.02, 4);
  return poses;
}

class LoopCloserTest : public testing::Test {
 protected:
  /// Walks round; the map takes each step with the same small error. True once the loop is closed.
  bool walk_round(LoopCloser& closer) { return walk(closer, 0, way_round().size()); }

  /// The part of the way from one step to another.
  bool walk(LoopCloser& closer, std::size_t begin, std::size_t end) {
    const std::vector<SE3> truth = way_round();
    const SE3 error =
        SE3::exp((Vector6d() << 0.004, -0.002, 0.003, 0.0004, 0.0006, -0.0003).finished());
    for (std::size_t i = begin; i < end; ++i) {
      if (i > 0) T_map_camera_ = T_map_camera_ * truth[i - 1].inverse() * truth[i] * error;
      closer.add(made_.insert(wall_, truth[i], T_map_camera_));
      truth_.push_back(truth[i]);
      error_before_ = worst_error();
      if (closer.close(made_.map, i, 0, {})) return true;
    }
    return false;
  }

  double worst_error() const {
    double worst = 0.0;
    for (const auto& [id, keyframe] : made_.map.keyframes()) {
      const SE3 error = truth_[id].inverse() * keyframe.T_world_camera;
      worst = std::max(worst, error.translation().norm());
    }
    return worst;
  }

  /// Of the part of a loop that each half of it saw.
  int shared_with_start() const {
    const auto& newest = made_.map.keyframes().rbegin()->second;
    int shared = 0;
    for (const Covisibility& neighbour : made_.map.covisible_with(newest)) {
      if (neighbour.keyframe < 4) shared += neighbour.shared;
    }
    return shared;
  }

  synthetic::HandMadeMap made_;
  synthetic::Scene wall_{
      {{.z = 3.0, .corner = {-3.0, -7.0}, .extent = {6.0, 6.0}, .texture_seed = 1},
       {.z = 3.0, .corner = {3.0, -7.0}, .extent = {6.0, 6.0}, .texture_seed = 2},
       {.z = 3.0, .corner = {-3.0, -1.0}, .extent = {6.0, 6.0}, .texture_seed = 3},
       {.z = 3.0, .corner = {3.0, -1.0}, .extent = {6.0, 6.0}, .texture_seed = 4},
       {.z = 2.5, .corner = {-0.9, -0.4}, .extent = {0.8, 0.6}, .texture_seed = 5}}};
  std::vector<SE3> truth_;
  SE3 T_map_camera_ = way_round().front();
  double error_before_ = 0.0;
};

TEST_F(LoopCloserTest, TakesTheDriftOutOfALongWay) {
  LoopCloser closer(made_.model, made_.config);
  ASSERT_TRUE(walk_round(closer));
  EXPECT_GT(error_before_, 0.15);
  const double after_graph = worst_error();
  EXPECT_LT(after_graph, 0.4 * error_before_);
  EXPECT_GT(shared_with_start(), 100) << "both sides see the same points now";
  ASSERT_TRUE(closer.is_adjusting());
  EXPECT_TRUE(closer.adjust(made_.map, {}));
  EXPECT_FALSE(closer.is_adjusting());
  EXPECT_LT(worst_error(), 0.1 * error_before_);
  EXPECT_LT(worst_error(), after_graph);
  RecordProperty("worst_error_before_m", std::to_string(error_before_));
  RecordProperty("worst_error_after_graph_m", std::to_string(after_graph));
  RecordProperty("worst_error_after_adjustment_m", std::to_string(worst_error()));
}

TEST_F(LoopCloserTest, ClosesALoopWithTheOldPartOfAMapThatWasKept) {
  LoopCloser of_first_session(made_.model, made_.config);
  ASSERT_FALSE(walk(of_first_session, 0, 25));
  LoopCloser of_second_session(made_.model, made_.config);
  of_second_session.take_over(made_.map, of_first_session.loops(), false);
  ASSERT_TRUE(walk(of_second_session, 25, way_round().size()));
  EXPECT_LT(worst_error(), 0.4 * error_before_);
}

TEST_F(LoopCloserTest, AdjustsInSlicesWhileTheMapGoesOn) {
  LoopCloser closer(made_.model, made_.config);
  ASSERT_TRUE(walk_round(closer));
  int slices = 0;
  int inserted = 0;
  while (!closer.adjust(made_.map, [] { return true; })) {
    ASSERT_LT(++slices, 100);
    if (inserted == 2) continue;
    ++inserted;
    const SE3 T_world_camera = truth_.back() * pose_at(0.1, 0.0, 0.0);
    const SE3 T_last_camera = truth_.back().inverse() * T_world_camera;
    const auto& newest = made_.map.keyframes().rbegin()->second;
    closer.add(made_.insert(wall_, T_world_camera, newest.T_world_camera * T_last_camera));
    truth_.push_back(T_world_camera);
  }
  EXPECT_GE(slices, 2);
  EXPECT_EQ(inserted, 2);
  EXPECT_LT(worst_error(), 0.06 * error_before_);
}

TEST_F(LoopCloserTest, LeavesTheMapAloneWhereItIsSwitchedOff) {
  made_.config.loop.enabled = false;
  LoopCloser closer(made_.model, made_.config);
  EXPECT_FALSE(walk_round(closer));
  EXPECT_FALSE(closer.is_adjusting());
}

TEST_F(LoopCloserTest, RemembersALoopWhenItsKeyframeLeaves) {
  LoopCloser closer(made_.model, made_.config);
  ASSERT_TRUE(walk_round(closer));
  const KeyframeId newest = made_.map.keyframes().rbegin()->first;
  const SE3 T_parent_camera = made_.map.keyframe(newest - 1).T_world_camera.inverse() *
                              made_.map.keyframe(newest).T_world_camera;
  const Features features = *made_.map.keyframe(newest).features;
  closer.remove(newest, newest - 1, T_parent_camera);
  for (const PlaceCandidate& candidate : closer.recall(features)) {
    EXPECT_NE(candidate.keyframe, newest);
  }
  made_.map.remove_keyframe(newest);
  EXPECT_TRUE(closer.adjust(made_.map, {}));
  EXPECT_LT(worst_error(), 0.1 * error_before_);
}

}  // namespace
}  // namespace tsg
