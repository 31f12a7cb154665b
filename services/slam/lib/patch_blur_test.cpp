#include "services/slam/lib/patch_blur.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace tsg {
namespace {

void expect_gaussian(const cv::Mat& image, PatchBlur& blur) {
  cv::Mat ours;
  cv::Mat theirs;
  blur.blur(image, ours);
  cv::GaussianBlur(image, theirs, {7, 7}, 2.0, 2.0);
  EXPECT_EQ(cv::countNonZero(ours != theirs), 0) << image.size();
}

TEST(PatchBlur, IsThatOfOpenCvWhateverTheSizeAndTheImageBefore) {
  PatchBlur blur;
  cv::RNG random(1);
  for (const cv::Size& size : {cv::Size(4, 4), cv::Size(64, 9), cv::Size(31, 50), cv::Size(9, 5)}) {
    cv::Mat image(size, CV_8UC1);
    random.fill(image, cv::RNG::UNIFORM, 0, 256);
    expect_gaussian(image, blur);
  }
}

TEST(PatchBlur, BlursRowsThatDoNotFollowOneAnother) {
  PatchBlur blur;
  cv::Mat image(40, 60, CV_8UC1);
  cv::RNG(2).fill(image, cv::RNG::UNIFORM, 0, 256);
  expect_gaussian(image(cv::Rect(3, 5, 37, 20)).clone(), blur);
  cv::Mat ours;
  cv::Mat of_copy;
  blur.blur(image(cv::Rect(3, 5, 37, 20)), ours);
  blur.blur(image(cv::Rect(3, 5, 37, 20)).clone(), of_copy);
  EXPECT_EQ(cv::countNonZero(ours != of_copy), 0);
}

TEST(PatchBlur, KeepsTheDarkestAndTheBrightest) {
  PatchBlur blur;
  cv::Mat image(20, 30, CV_8UC1, cv::Scalar(0));
  expect_gaussian(image, blur);
  image = 255;
  expect_gaussian(image, blur);
}

}  // namespace
}  // namespace tsg
