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

TEST(CameraModel, ResizedSeesThePointsOfTheImageInTheSamePlaces) {
  const CameraModel camera = vga_camera();
  const CameraModel small = camera.resized(160, 120);
  EXPECT_EQ(small.width, 160);
  EXPECT_EQ(small.height, 120);
  const Eigen::Vector3d p_camera(0.3, -0.2, 2.0);
  const Eigen::Vector2d from_edge = camera.project(p_camera) + Eigen::Vector2d(0.5, 0.5);
  const Eigen::Vector2d small_from_edge = small.project(p_camera) + Eigen::Vector2d(0.5, 0.5);
  EXPECT_TRUE(small_from_edge.isApprox(from_edge / 4.0, 1e-12));
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

TEST(CameraModel, DescribesItselfForMessages) {
  CameraModel camera = vga_camera();
  camera.fx = 525.123456;
  EXPECT_NE(camera.describe().find("640x480, fx 525.123456"), std::string::npos);
  EXPECT_EQ(camera.describe().find("distortion"), std::string::npos);
  camera.distortion[1] = -0.25;
  EXPECT_NE(camera.describe().find("distortion 0 -0.25 0 0 0"), std::string::npos);
}

}  // namespace
}  // namespace tsg
