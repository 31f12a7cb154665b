#include "services/slam/lib/map.hpp"

#include <gtest/gtest.h>

#include "services/slam/lib/keyframe_policy.hpp"
#include "services/slam/lib/map_culling.hpp"
#include "services/slam/lib/map_motion.hpp"
#include "services/slam/lib/snapshot_builder.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

constexpr std::size_t kFeatures = 40;

class MapTest : public testing::Test {
 protected:
  /// A keyframe in which feature i shows points[i], at x metres.
  Keyframe& add_keyframe(KeyframeId id, double x, const std::vector<PointId>& points) {
    auto features = std::make_shared<Features>();
    features->seq = id;
    features->items.resize(kFeatures);
    features->descriptors.resize(kFeatures);
    Keyframe& keyframe = map_.add_keyframe({.id = id,
                                            .features = features,
                                            .T_world_camera = synthetic::pose_at(x, 0.0, 0.0),
                                            .points = std::vector<PointId>(kFeatures, kNoPoint),
                                            .banned = std::vector<bool>(kFeatures, false)});
    for (std::size_t i = 0; i < points.size(); ++i) {
      Map::add_observation(*map_.find_point(points[i]), keyframe, static_cast<int>(i));
    }
    return keyframe;
  }
  std::vector<PointId> add_points(Keyframe& keyframe, int first, int count) {
    std::vector<PointId> points;
    for (int i = first; i < first + count; ++i) {
      points.push_back(map_.add_point({0.1 * i, 0.0, 2.0}, keyframe, i));
    }
    return points;
  }

  Map map_;
  ObservationModel model_{synthetic::camera(), SlamConfig{}};
};

TEST_F(MapTest, KeepsBothEndsOfAnObservationInStep) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto points = add_points(first, 0, 3);
  add_keyframe(1, 0.1, points);
  map_.remove_observation(points[1], 0);
  EXPECT_EQ(map_.keyframe(0).points[1], kNoPoint);
  EXPECT_EQ(map_.find_point(points[1])->observations.size(), 1U);
  map_.remove_keyframe(1);
  EXPECT_EQ(map_.find_point(points[1]), nullptr) << "no observation is left of it";
  EXPECT_EQ(map_.find_point(points[0])->observations.size(), 1U);
}

TEST_F(MapTest, TakesOutAnObservationThatMayBeGone) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto points = add_points(first, 0, 2);
  add_keyframe(1, 0.1, points);
  EXPECT_TRUE(map_.remove_observation_if_any(points[0], 1));
  EXPECT_FALSE(map_.remove_observation_if_any(points[0], 1));
  EXPECT_FALSE(map_.remove_observation_if_any(points[0], 5));
  map_.remove_point(points[1]);
  EXPECT_FALSE(map_.remove_observation_if_any(points[1], 0));
  EXPECT_EQ(map_.find_point(points[0])->observations.size(), 1U);
}

TEST_F(MapTest, MovesPointsAlongWithTheKeyframeThatMadeThem) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto old_points = add_points(first, 0, 1);
  Keyframe& second = add_keyframe(1, 0.5, old_points);
  const auto new_points = add_points(second, 1, 1);
  add_keyframe(2, 0.7, new_points);
  const Eigen::Vector3d old_position = map_.find_point(old_points[0])->position;
  const Eigen::Vector3d new_position = map_.find_point(new_points[0])->position;
  move_map(map_, model_,
           {{0, map_.keyframe(0).T_world_camera}, {1, synthetic::pose_at(0.5, 0.0, 0.3)}});
  EXPECT_TRUE(map_.find_point(old_points[0])->position.isApprox(old_position));
  EXPECT_TRUE(map_.find_point(new_points[0])
                  ->position.isApprox(new_position + Eigen::Vector3d(0.0, 0.0, 0.3)));
  EXPECT_TRUE(
      map_.keyframe(2).T_world_camera.translation().isApprox(Eigen::Vector3d(0.7, 0.0, 0.3)))
      << "a keyframe without a target goes along with the one before";
}

TEST_F(MapTest, RecallsKeyframesWithTheirNeighbours) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto points = add_points(first, 0, 20);
  add_keyframe(1, 0.1, points);
  Keyframe& far = add_keyframe(2, 9.0, {});
  add_points(far, 0, 20);
  add_keyframe(3, 20.0, {});
  const LocalMapSnapshot snapshot = build_recall_snapshot(map_, MapperConfig{}, 3, {2, 0});
  EXPECT_EQ(snapshot.newest, 3U);
  EXPECT_EQ(snapshot.recalled, (std::vector<KeyframeId>{2, 0}));
  EXPECT_NE(snapshot.find_keyframe(0), nullptr);
  EXPECT_NE(snapshot.find_keyframe(1), nullptr) << "shares points with a recalled one";
  EXPECT_NE(snapshot.find_keyframe(2), nullptr);
  EXPECT_EQ(snapshot.find_keyframe(3), nullptr);
  EXPECT_EQ(snapshot.points.size(), 40U);
}

TEST_F(MapTest, JoinsNeitherATakenNorABannedFeature) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto points = add_points(first, 0, 2);
  Keyframe& second = add_keyframe(1, 0.1, {points[0]});
  second.banned[1] = true;
  EXPECT_FALSE(Map::add_observation(*map_.find_point(points[1]), second, 0));
  EXPECT_FALSE(Map::add_observation(*map_.find_point(points[1]), second, 1));
  EXPECT_TRUE(Map::add_observation(*map_.find_point(points[1]), second, 2));
  EXPECT_FALSE(Map::add_observation(*map_.find_point(points[1]), second, 3)) << "seen once only";
}

TEST_F(MapTest, MergingGivesAllSightingsToOnePoint) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto left = add_points(first, 0, 1);
  Keyframe& second = add_keyframe(1, 0.1, {});
  const auto right = add_points(second, 5, 1);
  map_.merge_points(right[0], left[0]);
  EXPECT_EQ(map_.find_point(right[0]), nullptr);
  EXPECT_EQ(map_.keyframe(1).points[5], left[0]);
  EXPECT_EQ(map_.find_point(left[0])->observations.size(), 2U);
}

TEST_F(MapTest, CountsSharedPointsMostFirst) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto points = add_points(first, 0, 10);
  add_keyframe(1, 0.1, {points[0], points[1]});
  add_keyframe(2, 0.2, {points[0], points[1], points[2]});
  const auto neighbours = map_.covisible_with(map_.keyframe(0));
  ASSERT_EQ(neighbours.size(), 2U);
  EXPECT_EQ(neighbours[0].keyframe, 2U);
  EXPECT_EQ(neighbours[0].shared, 3);
  EXPECT_EQ(neighbours[1].shared, 2);
}

TEST_F(MapTest, CullsPointsThatNobodyElseSawOrThatTrackingMisses) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto points = add_points(first, 0, 3);
  map_.find_point(points[2])->expected = 20;
  map_.find_point(points[2])->found = 2;
  add_keyframe(1, 0.1, {points[0], points[2]});
  std::vector<PointId> recent = points;
  cull_recent_points(map_, 1, recent);
  EXPECT_NE(map_.find_point(points[1]), nullptr) << "still on trial";
  EXPECT_EQ(map_.find_point(points[2]), nullptr) << "found in 2 of 20 frames";
  cull_recent_points(map_, 2, recent);
  EXPECT_NE(map_.find_point(points[0]), nullptr);
  EXPECT_EQ(map_.find_point(points[1]), nullptr) << "one sighting after two more keyframes";
}

TEST_F(MapTest, FindsTheKeyframeThatOthersMakeRedundantButNeverTheFirst) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto points = add_points(first, 0, 20);
  add_keyframe(1, 0.1, points);
  add_keyframe(2, 0.2, points);
  EXPECT_FALSE(find_redundant_keyframe(map_, MapperConfig{}, 2));
  add_keyframe(3, 0.3, points);
  EXPECT_EQ(find_redundant_keyframe(map_, MapperConfig{}, 3), 1U);
}

TEST_F(MapTest, SnapshotIsSortedBoundedAndHoldsTheNewest) {
  Keyframe& first = add_keyframe(0, 0.0, {});
  const auto points = add_points(first, 0, 20);
  for (const PointId id : points) map_.update_appearance(*map_.find_point(id), model_);
  for (KeyframeId id = 1; id < 8; ++id) add_keyframe(id, 0.1 * static_cast<double>(id), points);
  MapperConfig config;
  config.snapshot_keyframes = 3;
  const LocalMapSnapshot snapshot = build_snapshot(map_, config, 7);
  ASSERT_EQ(snapshot.keyframes.size(), 3U);
  EXPECT_EQ(snapshot.map_keyframes, 8U);
  EXPECT_NE(snapshot.find_keyframe(7), nullptr);
  EXPECT_EQ(snapshot.find_keyframe(99), nullptr);
  for (const PointId id : points) EXPECT_NE(snapshot.find_point(id), nullptr);
}

TEST(KeyframePolicy, NeverInsertsWhereAKeyframeStandsAlready) {
  const TrackerConfig config;
  const KeyframeEvidence nothing_matches{
      .nearest_view_change = 0.01, .map_inliers = 0, .reference_points = 500};
  EXPECT_FALSE(is_worth_a_keyframe(nothing_matches, config));
}

TEST(KeyframePolicy, InsertsOnAnotherViewOrLittleOverlap) {
  const TrackerConfig config;
  EXPECT_TRUE(is_worth_a_keyframe({0.3, 500, 500}, config));
  EXPECT_TRUE(is_worth_a_keyframe({0.05, 100, 500}, config));
  EXPECT_FALSE(is_worth_a_keyframe({0.05, 490, 500}, config));
}

TEST(ViewChange, MeasuresTranslationByTheScenesDepth) {
  EXPECT_DOUBLE_EQ(view_change(synthetic::pose_at(0.3, 0.0, 0.0), 3.0), 0.1);
  EXPECT_NEAR(view_change(synthetic::pose_at(0.0, 0.0, 0.0, 0.2), 3.0), 0.2, 1e-12);
}

}  // namespace
}  // namespace tsg
