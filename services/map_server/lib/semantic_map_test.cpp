#include "services/map_server/lib/semantic_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace tsg {
namespace {

/// Camera looking along world x from 1 m above the floor, at the place `t_world_camera`.
SE3 looking_forward(const Eigen::Vector3d& t_world_camera) {
  Eigen::Matrix3d R_world_camera;
  R_world_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {R_world_camera, t_world_camera};
}

/// A grey wall 3 m ahead with a tv on it, and a red person 1.5 m ahead, 0.5 m wide.
class RoomTest : public testing::Test {
 protected:
  static constexpr std::uint8_t kTvLabel = 1;
  static constexpr std::uint8_t kPersonLabel = 2;

  MapKeyframe wall_with_tv() const {
    MapKeyframe keyframe;
    keyframe.T_world_camera = looking_forward({0.0, 0.0, 1.0});
    keyframe.frame.camera = {320, 240, 260.0, 260.0, 160.0, 120.0, {}};
    keyframe.frame.colour = cv::Mat(240, 320, CV_8UC3, cv::Scalar(128, 128, 128));
    keyframe.frame.depth = cv::Mat1w(240, 320, std::uint16_t{3030});
    keyframe.has_labels = true;
    keyframe.instances.labels = cv::Mat1b(240, 320, std::uint8_t{0});
    keyframe.instances.labels(tv_).setTo(kTvLabel);
    keyframe.instances.instances = {{"tv", 1.0F, {}, MotionVerdict::kUnknown},
                                    {"person", 1.0F, {}, MotionVerdict::kUnknown}};
    return keyframe;
  }

  MapKeyframe with_person() const {
    MapKeyframe keyframe = wall_with_tv();
    keyframe.frame.depth(person_).setTo(1500);
    keyframe.frame.colour(person_).setTo(cv::Scalar(0, 0, 255));
    keyframe.instances.labels(person_).setTo(kPersonLabel);
    return keyframe;
  }

  /// Occupied leaves between the camera and half a metre in front of the wall.
  int leaves_in_the_open() const {
    int count = 0;
    const SemanticOctree& tree = map_.octree();
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
      count += leaf.getX() < 2.5 && tree.isNodeOccupied(*leaf) ? 1 : 0;
    }
    return count;
  }

  const cv::Rect tv_{200, 60, 60, 40};
  const cv::Rect person_{100, 40, 87, 200};
  SemanticMap map_{MapConfig{}};
};

TEST_F(RoomTest, HoldsNothingWhereAPersonStood) {
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(map_.integrate(with_person()));
  EXPECT_EQ(leaves_in_the_open(), 0);
  for (const CloudPoint& point : map_.static_cloud()) {
    EXPECT_GT(point.position.x(), 2.9F);
    EXPECT_EQ(point.colour, (Rgb{128, 128, 128}));
  }
}

TEST_F(RoomTest, PutsTheWallAtItsPlaceInTheWorld) {
  ASSERT_TRUE(map_.integrate(wall_with_tv()));
  const SemanticNode* wall = map_.octree().search(3.03, 0.5, 1.0);
  ASSERT_NE(wall, nullptr);
  EXPECT_TRUE(map_.octree().isNodeOccupied(wall));
  EXPECT_EQ(wall->getColor(), octomap::ColorOcTreeNode::Color(128, 128, 128));
  EXPECT_EQ(map_.octree().search(3.08, 0.5, 1.0), nullptr);
  const Cloud cloud = map_.static_cloud();
  EXPECT_TRUE(std::all_of(cloud.begin(), cloud.end(), [](const CloudPoint& point) {
    return std::abs(point.position.x() - 3.03F) < 1e-3F;
  }));
}

TEST_F(RoomTest, ColoursTheTvByItsClassAndCountsIt) {
  ASSERT_TRUE(map_.integrate(wall_with_tv()));
  // The middle of the tv: pixel (230, 80) is 0.27 rad to the right, 0.15 up.
  const SemanticNode* tv = map_.octree().search(3.03, -3.03 * 70 / 260, 1.0 + 3.03 * 40 / 260);
  ASSERT_NE(tv, nullptr);
  const Rgb colour = class_colour("tv");
  EXPECT_EQ(tv->getColor(), octomap::ColorOcTreeNode::Color(colour.r, colour.g, colour.b));
  const MapSummary summary = map_.summary();
  ASSERT_EQ(summary.objects.size(), 1U);
  EXPECT_EQ(summary.objects[0].name, "tv");
  EXPECT_EQ(summary.objects[0].max_in_view, 1);
  // 0.70 m x 0.47 m of 5 cm leaves, more or less a row at each rim.
  EXPECT_NEAR(double(summary.objects[0].leaves), 14 * 9.3, 30);
}

TEST_F(RoomTest, LetsAPersonFadeWhoWasMissedOnce) {
  MapKeyframe missed = with_person();
  missed.has_labels = false;
  ASSERT_TRUE(map_.integrate(missed));
  EXPECT_GT(leaves_in_the_open(), 50);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(map_.integrate(wall_with_tv()));
  EXPECT_EQ(leaves_in_the_open(), 0);
  const Cloud cloud = map_.static_cloud();
  EXPECT_TRUE(std::none_of(cloud.begin(), cloud.end(),
                           [](const CloudPoint& point) { return point.position.x() < 2.5F; }));
  EXPECT_EQ(map_.summary().keyframes_without_labels, 1U);
}

TEST_F(RoomTest, LeavesOutAChairThatMovesAndKeepsOneThatDoesNot) {
  MapKeyframe keyframe = with_person();
  keyframe.instances.instances[1] = {"chair", 1.0F, {}, MotionVerdict::kStatic};
  ASSERT_TRUE(map_.integrate(keyframe));
  EXPECT_GT(leaves_in_the_open(), 50);
  SemanticMap other{MapConfig{}};
  keyframe.instances.instances[1].motion = MotionVerdict::kMoving;
  ASSERT_TRUE(other.integrate(keyframe));
  EXPECT_EQ(other.summary().objects.size(), 1U);  // the tv
}

TEST_F(RoomTest, CountsPointsBeforeAndAfterFiltering) {
  const auto first = map_.integrate(wall_with_tv());
  ASSERT_TRUE(first);
  EXPECT_EQ(first->points_raw, 320U * 240U);
  ASSERT_TRUE(map_.integrate(wall_with_tv()));
  const MapSummary summary = map_.summary();
  EXPECT_EQ(summary.keyframes, 2U);
  EXPECT_EQ(summary.points_raw, 2 * 320U * 240U);
  // The second look at the same wall adds no point: 3.73 m x 2.80 m of 2 cm voxels.
  EXPECT_EQ(summary.points, first->points);
  EXPECT_NEAR(double(summary.points), 187 * 140, 500);
}

TEST_F(RoomTest, RefusesAKeyframeThatIsNotSoundAndStaysAsItWas) {
  ASSERT_TRUE(map_.integrate(wall_with_tv()));
  const std::string before = map_.octree().to_ot();
  MapKeyframe nowhere = wall_with_tv();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  nowhere.T_world_camera = looking_forward({nan, 0.0, 0.0});
  EXPECT_FALSE(map_.integrate(nowhere));
  MapKeyframe far_away = wall_with_tv();
  far_away.T_world_camera = looking_forward({1e7, 0.0, 0.0});
  EXPECT_FALSE(map_.integrate(far_away));
  MapKeyframe blind = wall_with_tv();
  blind.frame.depth.setTo(0);
  EXPECT_FALSE(map_.integrate(blind));
  EXPECT_EQ(map_.octree().to_ot(), before);
  EXPECT_EQ(map_.summary().keyframes, 1U);
}

TEST_F(RoomTest, IsTheSameForTheSameKeyframes) {
  SemanticMap other{MapConfig{}};
  for (const MapKeyframe& keyframe : {with_person(), wall_with_tv()}) {
    ASSERT_TRUE(map_.integrate(keyframe));
    ASSERT_TRUE(other.integrate(keyframe));
  }
  EXPECT_EQ(map_.octree().to_ot(), other.octree().to_ot());
  EXPECT_EQ(map_.static_cloud().size(), other.static_cloud().size());
}

TEST_F(RoomTest, SurvivesAnyImagesFromTheEdgeOfTheMap) {
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE(kSeed);
  cv::RNG random(kSeed);
  MapKeyframe keyframe = with_person();
  std::size_t accepted = 0;
  for (int round = 0; round < 6; ++round) {
    cv::Mat small(12, 16, CV_16UC1);
    random.fill(small, cv::RNG::UNIFORM, 0, round % 2 == 0 ? 65536 : 4000);
    cv::resize(small, keyframe.frame.depth, keyframe.frame.depth.size(), 0, 0, cv::INTER_NEAREST);
    random.fill(keyframe.instances.labels, cv::RNG::UNIFORM, 0, 3);
    keyframe.T_world_camera =
        looking_forward({round % 2 == 0 ? 500.0 : -500.0, 499.0, round * 100.0 - 500.0});
    accepted += map_.integrate(keyframe) ? 1 : 0;
  }
  EXPECT_EQ(accepted, 6U);
  EXPECT_EQ(map_.octree().size(), map_.octree().calcNumNodes());
  EXPECT_GE(map_.summary().points_raw, map_.summary().points);
}

TEST(MapConfig, NamesEveryUnusableSetting) {
  EXPECT_THAT(MapConfig{}.problems(), testing::IsEmpty());
  MapConfig config;
  config.cloud_voxel_m = 1.0;
  config.max_extent_m = 1e6;
  config.exclusion.margin_px = -1;
  EXPECT_EQ(config.problems().size(), 3U);
}

}  // namespace
}  // namespace tsg
