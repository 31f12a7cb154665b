#include "services/map_server/lib/keyframe_view.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <opencv2/core.hpp>

namespace tsg {
namespace {

constexpr double kVoxelM = 0.1;  // of four pixels a side

/// A wall 2 m ahead: a chair on its left third, a person on its middle third.
MapKeyframe chair_and_person() {
  MapKeyframe keyframe;
  keyframe.id = 7;
  keyframe.frame.stamp_ns = 42;
  keyframe.frame.camera = {96, 64, 80.0, 80.0, 47.5, 31.5, {}};
  keyframe.frame.colour = cv::Mat(64, 96, CV_8UC3, cv::Scalar(10, 20, 30));
  keyframe.frame.depth = cv::Mat1w(64, 96, std::uint16_t{2000});
  keyframe.has_labels = true;
  keyframe.instances.labels = cv::Mat1b(64, 96, std::uint8_t{0});
  keyframe.instances.labels.colRange(0, 32).setTo(1);
  keyframe.instances.labels.colRange(32, 64).setTo(2);
  keyframe.instances.instances = {{"chair", 0.9F, {}, MotionVerdict::kStatic, 3},
                                  {"person", 0.8F, {}, MotionVerdict::kMoving, 4}};
  return keyframe;
}

std::uint32_t pixels_of(const Cloud& cloud) {
  return std::accumulate(
      cloud.begin(), cloud.end(), 0U,
      [](std::uint32_t sum, const CloudPoint& point) { return sum + point.weight; });
}

KeyframeView view_of(const MapKeyframe& keyframe) {
  ClassTable classes;
  return KeyframeViewer({}, {}, kVoxelM).view(keyframe, classes);
}

TEST(KeyframeView, HasThePointsOfEachInstanceAmongAllPoints) {
  const KeyframeView view = view_of(chair_and_person());
  EXPECT_EQ(view.id, 7U);
  EXPECT_EQ(view.stamp_ns, 42);
  ASSERT_EQ(view.instances.size(), 2U);
  const InstanceView& chair = view.instances[0];
  EXPECT_EQ(chair.instance.track_id, 3U);
  EXPECT_EQ(pixels_of(chair.points), 17U * 64U) << "all but what touches the person";
  for (const CloudPoint& point : chair.points) {
    EXPECT_LT(point.position.x(), 0.0F);
    EXPECT_EQ(point.class_id, 57);
  }
  EXPECT_EQ(pixels_of(view.points), view.points_raw);
  EXPECT_LT(view.points.size(), view.points_raw);
}

TEST(KeyframeView, TellsOfAPersonWithoutShowingAny) {
  const KeyframeView view = view_of(chair_and_person());
  EXPECT_EQ(view.instances[1].instance.class_name, "person");
  EXPECT_TRUE(view.instances[1].points.empty());
}

TEST(KeyframeView, OfAKeyframeWithoutLabelsHasNoInstances) {
  MapKeyframe keyframe = chair_and_person();
  keyframe.has_labels = false;
  keyframe.instances = {};
  const KeyframeView view = view_of(keyframe);
  EXPECT_FALSE(view.has_labels);
  EXPECT_TRUE(view.instances.empty());
  EXPECT_EQ(view.points_raw, 64U * 96U);
}

}  // namespace
}  // namespace tsg
