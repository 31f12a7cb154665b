#include "common/simulation/sensor/colour_sensor.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace tsg::simulation {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

/// Left half dark, right half bright.
render::Picture edge() {
  const cv::Size size(kWidth, kHeight);
  render::Picture picture{.radiance = cv::Mat(size, CV_32FC3, cv::Scalar::all(0.1)),
                          .depth_m = cv::Mat(size, CV_32FC1, cv::Scalar(2.0)),
                          .facing = cv::Mat(size, CV_32FC1, cv::Scalar(1.0)),
                          .tags = cv::Mat(size, CV_16UC1, cv::Scalar(1)),
                          .returns_depth = cv::Mat(size, CV_8UC1, cv::Scalar(255)),
                          .motion_px = cv::Mat(size, CV_32FC2, cv::Scalar::all(0))};
  picture.radiance.colRange(kWidth / 2, kWidth).setTo(cv::Scalar::all(0.6));
  return picture;
}

SensorDescription sensor_without_faults() {
  SensorDescription sensor;
  sensor.colour_noise = false;
  sensor.exposure_drift = false;
  sensor.vignetting = false;
  sensor.motion_blur = false;
  return sensor;
}

cv::Mat exposed(const SensorDescription& sensor,
                const render::Picture& picture,
                double time_s = 0.0,
                bool covered = false) {
  static const NoiseTable kNoise(1);
  return ColourSensor(sensor, kNoise, 1.0, 1).expose(picture, 5, time_s, covered);
}

int grey(const cv::Mat& image, int y, int x) { return image.at<cv::Vec3b>(y, x)[1]; }

TEST(ColourSensor, ShowsLightAsCodesWithAllFaultsOff) {
  const cv::Mat image = exposed(sensor_without_faults(), edge());
  EXPECT_NEAR(grey(image, 10, 10), 89, 1);   // sRGB of 0.1
  EXPECT_NEAR(grey(image, 10, 60), 203, 1);  // and of 0.6
}

TEST(ColourSensor, BlursAlongTheMotionOnly) {
  SensorDescription sensor = sensor_without_faults();
  sensor.motion_blur = true;
  render::Picture picture = edge();
  picture.motion_px.setTo(cv::Scalar(8.0, 0.0));
  const cv::Mat across = exposed(sensor, picture);
  EXPECT_GT(grey(across, 10, kWidth / 2 - 2), 100);
  EXPECT_LT(grey(across, 10, kWidth / 2 + 1), 195);
  EXPECT_NEAR(grey(across, 10, kWidth / 2 - 6), 89, 1);
  picture.motion_px.setTo(cv::Scalar(0.0, 8.0));
  const cv::Mat along = exposed(sensor, picture);
  EXPECT_NEAR(grey(along, 24, kWidth / 2 - 1), 89, 1);
}

TEST(ColourSensor, DarkensTheCorners) {
  SensorDescription sensor = sensor_without_faults();
  sensor.vignetting = true;
  const cv::Mat image = exposed(sensor, edge());
  EXPECT_LT(grey(image, 0, 0), grey(image, 24, 20) - 5);
  EXPECT_NEAR(grey(image, 24, 28), 89, 1);
}

TEST(ColourSensor, ExposureWanders) {
  SensorDescription sensor = sensor_without_faults();
  sensor.exposure_drift = true;
  int low = 255;
  int high = 0;
  for (double time_s = 0.0; time_s < 15.0; time_s += 0.5) {
    const int value = grey(exposed(sensor, edge(), time_s), 10, 60);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  EXPECT_GT(high - low, 5);
  EXPECT_LT(high - low, 40);
}

TEST(ColourSensor, NoiseIsThatOfPhotons) {
  SensorDescription sensor = sensor_without_faults();
  sensor.colour_noise = true;
  const cv::Mat image = exposed(sensor, edge());
  cv::Scalar mean;
  cv::Scalar dark;
  cv::Scalar bright;
  cv::meanStdDev(image.colRange(0, 30), mean, dark);
  cv::meanStdDev(image.colRange(34, 64), mean, bright);
  EXPECT_GT(dark[0], 0.5);
  EXPECT_LT(dark[0], 4.0);
  EXPECT_GT(bright[0], 0.5);
  EXPECT_LT(bright[0], 4.0);
}

TEST(ColourSensor, IsAlmostBlackBehindAHand) {
  const cv::Mat image = exposed(sensor_without_faults(), edge(), 0.0, true);
  double high = 0.0;
  cv::minMaxLoc(image.reshape(1), nullptr, &high);
  EXPECT_LT(high, 20.0);
}

}  // namespace
}  // namespace tsg::simulation
