#include "services/map_server/lib/back_projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <random>

namespace tsg {
namespace {

CameraModel small_camera() { return {64, 48, 50.0, 60.0, 31.0, 23.0, {}}; }

MapKeyframe wall(const CameraModel& camera, std::uint16_t depth_mm) {
  MapKeyframe keyframe;
  keyframe.frame.camera = camera;
  keyframe.frame.depth_units_per_metre = 1000.0;
  keyframe.frame.colour = cv::Mat(camera.height, camera.width, CV_8UC3, cv::Scalar(30, 20, 10));
  keyframe.frame.depth = cv::Mat1w(camera.height, camera.width, depth_mm);
  keyframe.has_labels = true;
  keyframe.instances.labels = cv::Mat1b(camera.height, camera.width, std::uint8_t{0});
  return keyframe;
}

KeyframeCloud project(const MapKeyframe& keyframe) {
  ClassTable classes;
  return BackProjector({}, {}).project(keyframe, classes);
}

std::size_t points_of_label(const KeyframeCloud& cloud, std::uint8_t label) {
  EXPECT_EQ(cloud.label_of_point.size(), cloud.points.size());
  return static_cast<std::size_t>(
      std::count(cloud.label_of_point.begin(), cloud.label_of_point.end(), label));
}

TEST(BackProjection, FollowsEquationsFiveAndSix) {
  const KeyframeCloud cloud = project(wall(small_camera(), 2000));
  ASSERT_EQ(cloud.points.size(), 64U * 48U);
  const CloudPoint& corner = cloud.points.front();  // pixel (0, 0)
  EXPECT_TRUE(corner.position.isApprox(
      Eigen::Vector3f(2.0F * (0 - 31) / 50, 2.0F * (0 - 23) / 60, 2.0F), 1e-6F));
  const CloudPoint& centre = cloud.points[23 * 64 + 31];  // the principal point
  EXPECT_TRUE(centre.position.isApprox(Eigen::Vector3f(0.0F, 0.0F, 2.0F), 1e-6F));
}

TEST(BackProjection, TurnsBgrPixelsIntoRgbPoints) {
  const KeyframeCloud cloud = project(wall(small_camera(), 2000));
  EXPECT_EQ(cloud.points.front().colour, (Rgb{10, 20, 30}));
}

TEST(BackProjection, UndistortsThePixelsOfADistortedCamera) {
  CameraModel camera{
      640, 480, 517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}};
  const KeyframeCloud cloud = project(wall(camera, 1500));
  ASSERT_EQ(cloud.points.size(), 640U * 480U);
  for (const int pixel : {0, 639, 320 * 640 + 100, 479 * 640 + 639}) {
    // Distorting the ray by OpenCV's model must lead back to the pixel.
    const Eigen::Vector3d p = cloud.points[std::size_t(pixel)].position.cast<double>();
    const double x = p.x() / p.z();
    const double y = p.y() / p.z();
    const double r2 = x * x + y * y;
    const auto& [k1, k2, p1, p2, k3] = camera.distortion;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double xd = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
    const double yd = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
    EXPECT_NEAR(camera.fx * xd + camera.cx, pixel % 640, 0.01);
    EXPECT_NEAR(camera.fy * yd + camera.cy, pixel / 640, 0.01);
  }
}

TEST(BackProjection, FollowsAChangeOfTheCamera) {
  ClassTable classes;
  BackProjector projector({}, {});
  (void)projector.project(wall(small_camera(), 2000), classes);
  CameraModel wider = small_camera();
  wider.fx = 25.0;
  const KeyframeCloud cloud = projector.project(wall(wider, 2000), classes);
  EXPECT_FLOAT_EQ(cloud.points.front().position.x(), 2.0F * (0 - 31) / 25);
}

TEST(BackProjection, LeavesOutPixelsThatNoPinholeCameraCouldSee) {
  CameraModel absurd = small_camera();
  absurd.fx = 1e-6;
  MapKeyframe keyframe = wall(absurd, 2000);
  EXPECT_LE(project(keyframe).points.size(), 48U);  // at most the column of the principal point
}

TEST(BackProjection, LabelsPointsByInstance) {
  MapKeyframe keyframe = wall(small_camera(), 2000);
  keyframe.instances.instances = {{"chair", 1.0F, {}, MotionVerdict::kStatic}};
  keyframe.instances.labels.rowRange(0, 10).setTo(1);
  const KeyframeCloud cloud = project(keyframe);
  EXPECT_EQ(cloud.points.front().class_id, 57);
  EXPECT_EQ(cloud.points.back().class_id, kBackgroundClass);
  EXPECT_EQ(points_of_label(cloud, 1), 640U);
  EXPECT_EQ(points_of_label(cloud, 0), 64U * 38U);
}

TEST(BackProjection, SaysThatPointsWithoutAMaskMayBeAnything) {
  MapKeyframe keyframe = wall(small_camera(), 2000);
  keyframe.has_labels = false;
  keyframe.instances.labels.release();
  const KeyframeCloud cloud = project(keyframe);
  EXPECT_EQ(cloud.points.front().class_id, kNotSegmentedClass);
}

TEST(BackProjection, SeesFreeSpaceInFrontOfWhatIsTooFar) {
  const KeyframeCloud cloud = project(wall(small_camera(), 8000));
  EXPECT_TRUE(cloud.points.empty());
  ASSERT_EQ(cloud.free_ends.size(), 16U * 12U);
  EXPECT_FLOAT_EQ(cloud.free_ends.front().z(), 5.0F);
}

TEST(BackProjection, MakesNoClaimWhereNothingWasMeasuredOrAPersonStands) {
  MapKeyframe keyframe = wall(small_camera(), 8000);
  keyframe.frame.depth.colRange(0, 32).setTo(0);
  keyframe.instances.instances = {{"person", 1.0F, {}, MotionVerdict::kUnknown}};
  keyframe.instances.labels.colRange(32, 64).setTo(1);
  const KeyframeCloud cloud = project(keyframe);
  EXPECT_TRUE(cloud.points.empty());
  EXPECT_TRUE(std::all_of(cloud.free_ends.begin(), cloud.free_ends.end(),
                          [](const Eigen::Vector3f& end) { return end.x() < 0.0F; }));
}

TEST(BackProjection, NeverMakesMorePointsThanPixelsNorLeavesTheRangeForAnyImages) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE(kSeed);
  cv::RNG random(kSeed);
  MapKeyframe keyframe = wall(small_camera(), 0);
  keyframe.instances.instances = {{"person", 1.0F, {}, MotionVerdict::kUnknown},
                                  {"chair", 1.0F, {}, MotionVerdict::kMoving},
                                  {"tv", 1.0F, {}, MotionVerdict::kStatic}};
  for (int round = 0; round < 20; ++round) {
    random.fill(keyframe.frame.depth, cv::RNG::UNIFORM, 0, round % 2 == 0 ? 65536 : 2000);
    random.fill(keyframe.frame.colour, cv::RNG::UNIFORM, 0, 256);
    random.fill(keyframe.instances.labels, cv::RNG::UNIFORM, 0, 4);
    const KeyframeCloud cloud = project(keyframe);
    EXPECT_LE(cloud.points.size(), 64U * 48U);
    EXPECT_EQ(points_of_label(cloud, 1) + points_of_label(cloud, 2), 0U);
    EXPECT_EQ(points_of_label(cloud, 0) + points_of_label(cloud, 3), cloud.points.size());
    for (const CloudPoint& point : cloud.points) {
      EXPECT_TRUE(point.position.z() >= 0.299F && point.position.z() <= 5.001F);
    }
  }
}

}  // namespace
}  // namespace tsg
