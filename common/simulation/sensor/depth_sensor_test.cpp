#include "common/simulation/sensor/depth_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "common/simulation/simulator.hpp"

namespace tsg::simulation {
namespace {

constexpr int kDepthWidth = 320;
constexpr int kDepthHeight = 240;

/// A wall at a depth, seen straight on.
render::Picture wall_at(float depth_m) {
  const cv::Size size(kDepthWidth, kDepthHeight);
  return {.radiance = cv::Mat(size, CV_32FC3, cv::Scalar::all(0.5)),
          .depth_m = cv::Mat(size, CV_32FC1, cv::Scalar(depth_m)),
          .facing = cv::Mat(size, CV_32FC1, cv::Scalar(1.0)),
          .tags = cv::Mat(size, CV_16UC1, cv::Scalar(1)),
          .returns_depth = cv::Mat(size, CV_8UC1, cv::Scalar(255)),
          .motion_px = cv::Mat(size, CV_32FC2, cv::Scalar::all(0))};
}

SensorDescription sensor_without_depth_faults() {
  SensorDescription sensor;
  sensor.camera = {
      .width = kDepthWidth, .height = kDepthHeight, .fx = 535.4, .fy = 539.2, .cx = 160, .cy = 120};
  sensor.depth_noise = false;
  sensor.depth_quantisation = false;
  sensor.depth_holes = false;
  sensor.depth_range = false;
  return sensor;
}

cv::Mat measured(const SensorDescription& sensor, const render::Picture& picture) {
  static const NoiseTable kNoise(1);
  return DepthSensor(sensor, kNoise).measure(picture, 3);
}

double deviation_m(const SensorDescription& sensor, float depth_m) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(measured(sensor, wall_at(depth_m)), mean, deviation);
  return deviation[0] / kDepthUnitsPerMetre;
}

TEST(DepthSensor, IsExactWithAllFaultsOff) {
  const cv::Mat raw = measured(sensor_without_depth_faults(), wall_at(2.5F));
  EXPECT_EQ(cv::norm(raw, cv::Mat(raw.size(), CV_16UC1, cv::Scalar(12500)), cv::NORM_INF), 0.0);
}

TEST(DepthSensor, NoiseGrowsWithTheSquareOfTheDepth) {
  SensorDescription sensor = sensor_without_depth_faults();
  sensor.depth_noise = true;
  const double at_1m = deviation_m(sensor, 1.0F);
  const double at_4m = deviation_m(sensor, 4.0F);
  EXPECT_NEAR(at_4m / at_1m, 16.0, 1.5);
  EXPECT_NEAR(at_1m, 1.4e-3, 0.4e-3) << "of the published 1.4 mm; patches are interpolated";
}

TEST(DepthSensor, QuantisesDisparity) {
  SensorDescription sensor = sensor_without_depth_faults();
  sensor.depth_quantisation = true;
  cv::Mat raw = measured(sensor, wall_at(4.03F));
  const double step_m = 4.0 * 4.0 / (580.0 * 0.075) * 0.125;
  EXPECT_EQ(raw.at<std::uint16_t>(0, 0), raw.at<std::uint16_t>(100, 100));
  EXPECT_NEAR(raw.at<std::uint16_t>(0, 0) / kDepthUnitsPerMetre, 4.03, 0.5 * step_m);
  int distinct = 0;
  std::uint16_t last = 0;
  for (float depth_m = 4.0F; depth_m < 5.0F; depth_m += 0.005F) {
    const auto value = measured(sensor, wall_at(depth_m)).at<std::uint16_t>(0, 0);
    distinct += value != last ? 1 : 0;
    last = value;
  }
  EXPECT_NEAR(distinct, 1.0 / (4.5 * 4.5 / (580.0 * 0.075) * 0.125), 3.0);
}

TEST(DepthSensor, SeesNothingOutOfRange) {
  SensorDescription sensor = sensor_without_depth_faults();
  sensor.depth_range = true;
  EXPECT_EQ(cv::countNonZero(measured(sensor, wall_at(0.3F))), 0);
  EXPECT_EQ(cv::countNonZero(measured(sensor, wall_at(7.0F))), 0);
  EXPECT_EQ(cv::countNonZero(measured(sensor, wall_at(2.0F))), kDepthWidth * kDepthHeight);
}

TEST(DepthSensor, LosesWhatTheProjectorCannotReachLeftOfThings) {
  SensorDescription sensor = sensor_without_depth_faults();
  sensor.depth_holes = true;
  render::Picture picture = wall_at(3.0F);
  picture.depth_m(cv::Rect(150, 0, 60, kDepthHeight)).setTo(1.0F);
  const cv::Mat raw = measured(sensor, picture);
  // fx * 7.5 cm * (1/1 m - 1/3 m) = 26.8 pixels.
  const cv::Mat shadow = raw(cv::Rect(150 - 25, 0, 22, kDepthHeight));
  const cv::Mat right = raw(cv::Rect(214, 0, 40, kDepthHeight));
  EXPECT_EQ(cv::countNonZero(shadow), 0);
  EXPECT_GT(cv::countNonZero(right), 0.98 * 40 * kDepthHeight);
  EXPECT_GT(cv::countNonZero(raw(cv::Rect(80, 0, 35, kDepthHeight))), 0.98 * 35 * kDepthHeight);
}

TEST(DepthSensor, GetsNoEchoFromGlassAndFewFromSurfacesSeenFlat) {
  SensorDescription sensor = sensor_without_depth_faults();
  sensor.depth_holes = true;
  render::Picture picture = wall_at(2.0F);
  picture.returns_depth.rowRange(0, 60).setTo(0);
  picture.facing.rowRange(60, 120).setTo(0.05F);
  picture.facing.rowRange(120, 180).setTo(0.16F);
  const cv::Mat raw = measured(sensor, picture);
  EXPECT_EQ(cv::countNonZero(raw.rowRange(0, 60)), 0);
  EXPECT_EQ(cv::countNonZero(raw.rowRange(60, 120)), 0);
  const int some = cv::countNonZero(raw.rowRange(120, 180));
  EXPECT_GT(some, 0.25 * 60 * kDepthWidth);
  EXPECT_LT(some, 0.75 * 60 * kDepthWidth);
}

TEST(DepthSensor, OtherFramesHaveOtherNoise) {
  SensorDescription sensor = sensor_without_depth_faults();
  sensor.depth_noise = true;
  const NoiseTable noise(1);
  const DepthSensor camera(sensor, noise);
  const render::Picture picture = wall_at(2.0F);
  EXPECT_EQ(cv::norm(camera.measure(picture, 1), camera.measure(picture, 1), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(camera.measure(picture, 1), camera.measure(picture, 2), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace tsg::simulation
