#include "services/segmentation/lib/decoders/mask_painter.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace tsg {
namespace {

/// Smooth noise between 0 and 1.
cv::Mat_<float> mask_of(cv::Size size, int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed));
  cv::Mat_<float> mask(size);
  random.fill(mask, cv::RNG::UNIFORM, 0.0, 1.0);
  cv::blur(mask, mask, {3, 3});
  return mask;
}

/// The mask enlarged, cut and scaled in the steps of OpenCV.
cv::Mat_<float> step_by_step(const cv::Mat_<float>& mask, const Letterbox& letterbox, int step) {
  cv::Mat large;
  cv::resize(mask, large, mask.size() * step, 0, 0, cv::INTER_LINEAR);
  cv::Mat in_frame;
  cv::resize(large(letterbox.image), in_frame, letterbox.frame_size, 0, 0, cv::INTER_LINEAR);
  return in_frame;
}

/// How many pixels of `labels` are not what `expected` makes of them; at one half rounding decides.
int count_different(const cv::Mat& labels, const cv::Mat_<float>& expected) {
  const cv::Mat is_sure = cv::abs(expected - 0.5F) > 1e-4F;
  return cv::countNonZero(((labels > 0) != (expected > 0.5F)) & is_sure);
}

void expect_same_as_step_by_step(cv::Size frame_size, cv::Size input_size, int step) {
  for (const Placement placement : {Placement::kTopLeft, Placement::kCentred}) {
    const Letterbox letterbox = make_letterbox(frame_size, input_size, placement);
    const cv::Mat_<float> mask = mask_of(input_size / step, 5);
    cv::Mat labels(frame_size, CV_8UC1, cv::Scalar(0));
    const cv::Rect box =
        paint_mask(mask, sample_whole_frame(letterbox, step, mask.size()), 7, labels);
    EXPECT_EQ(count_different(labels, step_by_step(mask, letterbox, step)), 0) << frame_size;
    EXPECT_EQ(cv::countNonZero(labels == 7), cv::countNonZero(labels));
    EXPECT_EQ(box, cv::boundingRect(labels));
  }
}

TEST(MaskPainter, EqualsEnlargingCuttingAndScalingStepByStep) {
  expect_same_as_step_by_step({64, 32}, {64, 32}, 4);   // as is
  expect_same_as_step_by_step({160, 80}, {64, 32}, 4);  // enlarged
  expect_same_as_step_by_step({100, 90}, {64, 32}, 4);  // enlarged, with a border
  expect_same_as_step_by_step({40, 20}, {64, 32}, 4);   // shrunk
  expect_same_as_step_by_step({50, 70}, {64, 48}, 1);   // of the input's resolution
}

TEST(MaskPainter, LeavesAllAsItWasWhereAMaskIsNowhereAboveOneHalf) {
  const Letterbox letterbox = make_letterbox({64, 32}, {64, 32});
  const cv::Mat_<float> mask(8, 16, 0.5F);
  cv::Mat labels(32, 64, CV_8UC1, cv::Scalar(3));
  EXPECT_TRUE(paint_mask(mask, sample_whole_frame(letterbox, 4, mask.size()), 7, labels).empty());
  EXPECT_EQ(cv::countNonZero(labels == 3), 64 * 32);
}

TEST(MaskPainter, ReachesTheEdgesOfTheFrame) {
  const Letterbox letterbox = make_letterbox({64, 32}, {64, 32});
  cv::Mat_<float> mask(8, 16, 0.0F);
  mask(7, 15) = 1.0F;
  cv::Mat labels(32, 64, CV_8UC1, cv::Scalar(0));
  const cv::Rect box = paint_mask(mask, sample_whole_frame(letterbox, 4, mask.size()), 7, labels);
  EXPECT_EQ(box.br(), cv::Point(64, 32));
}

}  // namespace
}  // namespace tsg
