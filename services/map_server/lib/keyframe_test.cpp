#include "services/map_server/lib/keyframe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

namespace tsg {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

MapKeyframe sound_keyframe() {
  MapKeyframe keyframe;
  keyframe.frame.camera = {64, 48, 50.0, 60.0, 31.0, 23.0, {}};
  keyframe.frame.colour = cv::Mat(48, 64, CV_8UC3, cv::Scalar(0, 0, 0));
  keyframe.frame.depth = cv::Mat1w(48, 64, std::uint16_t{1000});
  return keyframe;
}

/// The reason for the refusal, and "accepted" where there is none.
std::string verdict_on(const MapKeyframe& keyframe) {
  const auto checked = check_keyframe(keyframe, 100.0);
  return checked ? "accepted" : checked.error().message;
}

TEST(CheckKeyframe, AcceptsASoundOneWithAndWithoutLabels) {
  MapKeyframe keyframe = sound_keyframe();
  EXPECT_EQ(verdict_on(keyframe), "accepted");
  keyframe.has_labels = true;
  keyframe.instances.labels = cv::Mat1b(48, 64, std::uint8_t{1});
  keyframe.instances.instances = {{"chair", 1.0F, {}, MotionVerdict::kUnknown}};
  EXPECT_EQ(verdict_on(keyframe), "accepted");
}

TEST(CheckKeyframe, RefusesAPoseThatIsNotFinite) {
  MapKeyframe keyframe = sound_keyframe();
  keyframe.T_world_camera = SE3(Eigen::Quaterniond::Identity(), {0.0, kNan, 0.0});
  EXPECT_THAT(verdict_on(keyframe), testing::HasSubstr("not finite"));
  keyframe.T_world_camera = SE3(Eigen::Quaterniond(kNan, 0.0, 0.0, 1.0), {0.0, 0.0, 0.0});
  EXPECT_THAT(verdict_on(keyframe), testing::HasSubstr("not finite"));
}

TEST(CheckKeyframe, RefusesAnAbsurdPosition) {
  MapKeyframe keyframe = sound_keyframe();
  keyframe.T_world_camera = SE3(Eigen::Quaterniond::Identity(), {0.0, -1e6, 0.0});
  EXPECT_THAT(verdict_on(keyframe), testing::HasSubstr("farther than 100 m"));
}

TEST(CheckKeyframe, RefusesImagesThatDoNotBelongTogether) {
  MapKeyframe keyframe = sound_keyframe();
  keyframe.frame.depth = cv::Mat1w(24, 32, std::uint16_t{1000});
  EXPECT_THAT(verdict_on(keyframe), testing::HasSubstr("depth image is 32x24"));
}

TEST(CheckKeyframe, RefusesALabelWithoutInstance) {
  MapKeyframe keyframe = sound_keyframe();
  keyframe.has_labels = true;
  keyframe.instances.labels = cv::Mat1b(48, 64, std::uint8_t{3});
  EXPECT_THAT(verdict_on(keyframe), testing::HasSubstr("instance 3 of 0"));
}

TEST(CheckKeyframe, RefusesDepthThatIsAllZeroOrWithoutScale) {
  MapKeyframe keyframe = sound_keyframe();
  keyframe.frame.depth_units_per_metre = kNan;
  EXPECT_THAT(verdict_on(keyframe), testing::HasSubstr("depth_units_per_metre"));
  keyframe = sound_keyframe();
  keyframe.frame.depth.setTo(0);
  EXPECT_THAT(verdict_on(keyframe), testing::HasSubstr("no depth at all"));
}

TEST(CheckKeyframe, RefusesAnUnusableCamera) {
  MapKeyframe keyframe = sound_keyframe();
  keyframe.frame.camera.fx = 0.0;
  EXPECT_THAT(verdict_on(keyframe), testing::HasSubstr("fx must be > 0"));
}

}  // namespace
}  // namespace tsg
