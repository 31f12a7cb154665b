#include "services/tsgctl/simulate/scene_options.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

using simulation::SceneDescription;

TEST(SceneOptions, ThatAreAbsentLeaveTheSceneAsItIs) {
  SceneDescription scene;
  scene.seed = 7;
  scene.sensor.vignetting = false;
  ASSERT_TRUE(apply({}, scene));
  EXPECT_EQ(scene.seed, 7U);
  EXPECT_FALSE(scene.sensor.vignetting);
  EXPECT_TRUE(scene.sensor.depth_noise);
  EXPECT_EQ(scene.sensor.camera.width, 640);
}

TEST(SceneOptions, ChangeSeedAndSize) {
  SceneDescription scene;
  ASSERT_TRUE(apply({.seed = 0, .size = "160x120"}, scene));
  EXPECT_EQ(scene.seed, 0U);
  EXPECT_EQ(scene.sensor.camera, SceneDescription{}.sensor.camera.resized(160, 120));
}

TEST(SceneOptions, SwitchAllOrNoPartOfTheSensorModel) {
  SceneDescription scene;
  ASSERT_TRUE(apply({.noise = "all"}, scene));
  EXPECT_TRUE(scene.sensor.rolling_shutter);
  EXPECT_TRUE(scene.sensor.depth_holes);
  ASSERT_TRUE(apply({.noise = "none"}, scene));
  EXPECT_FALSE(scene.sensor.rolling_shutter);
  EXPECT_FALSE(scene.sensor.depth_range);
}

TEST(SceneOptions, SwitchThePartsThatAreNamedAndNoOther) {
  SceneDescription scene;
  ASSERT_TRUE(apply({.noise = "depth_noise,motion_blur"}, scene));
  EXPECT_TRUE(scene.sensor.depth_noise);
  EXPECT_TRUE(scene.sensor.motion_blur);
  EXPECT_FALSE(scene.sensor.depth_holes);
  EXPECT_FALSE(scene.sensor.colour_noise);
}

TEST(SceneOptions, ThatMakeNoSenseSayWhatWould) {
  SceneDescription scene;
  const auto noise = apply({.noise = "depth_noise,snow"}, scene);
  ASSERT_FALSE(noise);
  EXPECT_EQ(noise.error().code, ExitCode::kUsage);
  EXPECT_EQ(noise.error().message,
            "--noise: there is no \"snow\"; known: all none depth_noise depth_quantisation "
            "depth_holes depth_range colour_noise exposure_drift vignetting motion_blur "
            "rolling_shutter");
  for (const char* size : {"big", "320", "320x", "8x8", "4000x3000", "320x240p"}) {
    const auto sized = apply({.size = size}, scene);
    ASSERT_FALSE(sized) << size;
    EXPECT_EQ(sized.error().code, ExitCode::kUsage);
    EXPECT_EQ(sized.error().message, "--size \"" + std::string(size) +
                                         "\": write WIDTHxHEIGHT, 16x16 to 1280x720, e.g. 320x240");
  }
}

}  // namespace
}  // namespace tsg
