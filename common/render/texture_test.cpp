#include "common/render/texture.hpp"

#include <gtest/gtest.h>

namespace tsg::render {
namespace {

/// Left half black, right half white.
Texture half_and_half() {
  cv::Mat image(64, 64, CV_8UC3, cv::Scalar::all(0));
  image.colRange(32, 64).setTo(cv::Scalar::all(255));
  return Texture(image);
}

TEST(Texture, GivesLinearLightOfItsCodes) {
  const Texture grey(cv::Mat(4, 4, CV_8UC3, cv::Scalar(188, 0, 255)));
  const Eigen::Vector3f light = grey.sample({0.3F, 0.7F}, 0.0F);
  EXPECT_NEAR(light.x(), 0.5F, 0.01F);  // code 188 is half of the light
  EXPECT_FLOAT_EQ(light.y(), 0.0F);
  EXPECT_FLOAT_EQ(light.z(), 1.0F);
}

TEST(Texture, RepeatsBeyondItsEdges) {
  const Texture texture = half_and_half();
  for (const float whole : {-3.0F, -1.0F, 0.0F, 2.0F}) {
    EXPECT_FLOAT_EQ(texture.sample({whole + 0.25F, 0.5F}, 0.0F).x(), 0.0F);
    EXPECT_FLOAT_EQ(texture.sample({whole + 0.75F, 0.5F}, 0.0F).x(), 1.0F);
  }
}

TEST(Texture, AveragesOverTheFootprint) {
  const Texture texture = half_and_half();
  const float whole = texture.sample({0.25F, 0.5F}, 1.0F).x();
  EXPECT_GT(whole, 0.1F);
  EXPECT_LT(whole, 0.6F);
  EXPECT_FLOAT_EQ(texture.sample({0.9F, 0.1F}, 5.0F).x(), whole) << "no level beyond the last";
}

}  // namespace
}  // namespace tsg::render
