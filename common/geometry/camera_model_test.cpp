#include "common/geometry/camera_model.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace tsg {
namespace {

CameraModel vga_camera() {
  return {.width = 640, .height = 480, .fx = 535.4, .fy = 539.2, .cx = 320.1, .cy = 247.6};
}

TEST(CameraModel, ProjectUndoesUnproject) {
  const CameraModel camera = vga_camera();
  const Eigen::Vector2d pixel(12.5, 400.25);
  EXPECT_TRUE(camera.project(camera.unproject(pixel, 2.5)).isApprox(pixel, 1e-12));
}

TEST(CameraModel, SoundModelHasNoProblems) { EXPECT_TRUE(vga_camera().problems().empty()); }

TEST(CameraModel, NamesEveryProblemAtOnce) {
  CameraModel camera = vga_camera();
  camera.fx = std::numeric_limits<double>::quiet_NaN();
  camera.cy = 480.0;
  camera.distortion[2] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(camera.problems().size(), 3U);
}

TEST(CameraModel, KnowsWhetherItIsDistorted) {
  CameraModel camera = vga_camera();
  EXPECT_FALSE(camera.is_distorted());
  camera.distortion[4] = 1.1633;
  EXPECT_TRUE(camera.is_distorted());
}

}  // namespace
}  // namespace tsg
