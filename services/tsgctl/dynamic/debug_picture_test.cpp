#include "services/tsgctl/dynamic/debug_picture.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace tsg {
namespace {

const cv::Scalar kGround(40, 40, 40);

/// What the centre of a picture twice the size has where the image has `x`, `y`.
cv::Vec3b at(const cv::Mat& picture, int x, int y) {
  return picture.at<cv::Vec3b>(2 * y + 1, 2 * x + 1);
}

bool is_red(const cv::Vec3b& bgr) { return bgr[2] > 200 && bgr[0] < 120 && bgr[1] < 120; }
bool is_green(const cv::Vec3b& bgr) { return bgr[1] > 110 && bgr[0] < 120 && bgr[2] < 120; }
bool is_magenta(const cv::Vec3b& bgr) { return bgr[2] > 200 && bgr[0] > 200 && bgr[1] < 120; }

class DebugPicture : public ::testing::Test {
 protected:
  cv::Mat draw() {
    return draw_verdicts({.seq = 12,
                          .is_tracked = true,
                          .colour = cv::Mat(480, 640, CV_8UC3, kGround),
                          .mask = has_mask_ ? &mask_ : nullptr,
                          .verdicts = &verdicts_,
                          .config = &config_});
  }
  void mark(const cv::Rect& box, const std::string& class_name) {
    has_mask_ = true;
    mask_.frame_seq = 12;
    mask_.labels = cv::Mat(480, 640, CV_8UC1, cv::Scalar(0));
    mask_.labels(box) = 1;
    mask_.instances = {{class_name, 1.0F, cv::Rect2f(box)}};
  }

  DynamicFilterConfig config_;
  FrameVerdicts verdicts_;
  InstanceSegmentation mask_;
  bool has_mask_ = false;
};

TEST_F(DebugPicture, FeaturesAreColouredByVerdict) {
  verdicts_.features = {
      {.raw_x = 100, .raw_y = 100},
      {.raw_x = 200, .raw_y = 100, .prior = FeatureVerdict::kDynamic, .is_dynamic = true},
      {.raw_x = 300, .raw_y = 100, .prior = FeatureVerdict::kStatic, .is_dynamic = true}};
  const cv::Mat picture = draw();
  EXPECT_TRUE(is_green(at(picture, 100, 100)));
  EXPECT_TRUE(is_red(at(picture, 200, 100)));
  EXPECT_TRUE(is_magenta(at(picture, 300, 100)));
  EXPECT_EQ(at(picture, 400, 100), cv::Vec3b(40, 40, 40));
}

TEST_F(DebugPicture, OnlyFeaturesOffTheirEpipolarLineAreRinged) {
  // White is all that has much blue: neither the ground has nor what is kept.
  const auto bright = [](const cv::Mat& picture, int x, int y) {
    cv::Mat blue;
    cv::extractChannel(picture(cv::Rect(2 * x - 9, 2 * y - 9, 20, 20)), blue, 0);
    return cv::countNonZero(blue > 150);
  };
  verdicts_.features = {{.raw_x = 100, .raw_y = 100, .epipolar_px = 0.9F},
                        {.raw_x = 200, .raw_y = 100, .epipolar_px = 1.1F}};
  const cv::Mat picture = draw();
  EXPECT_EQ(bright(picture, 100, 100), 0);
  EXPECT_GT(bright(picture, 200, 100), 20);
}

TEST_F(DebugPicture, AnOutlineTellsTheStateOfItsInstance) {
  mark({100, 100, 80, 120}, "person");
  EXPECT_TRUE(is_red(at(draw(), 100, 160)));  // by its class, as long as nothing else is known
  verdicts_.instances = {{.id = 4,
                          .class_name = "person",
                          .prior = FeatureVerdict::kStatic,
                          .p_moving = 0.1,
                          .is_moving = false,
                          .box = {110, 105, 80, 120}}};
  EXPECT_TRUE(is_green(at(draw(), 100, 160)));
  verdicts_.instances[0].is_moving = true;
  EXPECT_TRUE(is_red(at(draw(), 100, 160)));
}

TEST_F(DebugPicture, InstancesAtTheBorderKeepTheirTextInside) {
  verdicts_.instances = {
      {.id = 4, .class_name = "chair", .is_moving = true, .box = {-20, -30, 60, 60}},
      {.id = 5, .class_name = "chair", .is_moving = true, .box = {620, 470, 60, 60}}};
  const cv::Mat picture = draw();
  EXPECT_EQ(picture.cols, 1280);
  EXPECT_GT(picture.rows, 960);  // and the legend
  for (const cv::Point corner : {cv::Point(0, 0), cv::Point(1180, 935)}) {
    cv::Mat red;
    cv::extractChannel(picture(cv::Rect(corner, cv::Size(100, 25))), red, 2);
    EXPECT_GT(cv::countNonZero(red > 150), 100) << corner;
  }
}

TEST_F(DebugPicture, WhatStaysAndIsExpectedToHasNoBox) {
  const cv::Mat empty = draw();
  verdicts_.instances = {{.id = 4, .class_name = "tv", .box = {100, 100, 80, 60}}};
  EXPECT_EQ(cv::norm(draw(), empty, cv::NORM_INF), 0.0);
  verdicts_.instances[0].prior = FeatureVerdict::kPotentiallyDynamic;
  EXPECT_GT(cv::norm(draw(), empty, cv::NORM_INF), 0.0);
}

TEST_F(DebugPicture, TheImageItselfStaysAsItIs) {
  const cv::Mat colour(480, 640, CV_8UC3, kGround);
  verdicts_.features = {{.raw_x = 100, .raw_y = 100}};
  (void)draw_verdicts(
      {.colour = colour, .mask = nullptr, .verdicts = &verdicts_, .config = &config_});
  EXPECT_EQ(colour.at<cv::Vec3b>(100, 100), cv::Vec3b(40, 40, 40));
}

}  // namespace
}  // namespace tsg
