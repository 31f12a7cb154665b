#include "common/render/renderer.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "common/render/preview.hpp"
#include "common/render/shapes.hpp"

namespace tsg::render {
namespace {

CameraModel small_camera() {
  return {.width = 64, .height = 48, .fx = 60.0, .fy = 60.0, .cx = 31.5, .cy = 23.5};
}

/// A wall of 10 x 10 m that faces -x, with its surface at x = 2.
Part wall() {
  Part part{.mesh = {}, .tag = 7};
  part.mesh.append(make_box({1, 10, 10}, {.returns_depth = false}),
                   SE3(Eigen::Quaterniond::Identity(), {2.5, 0, -5}));
  return part;
}

Lamp lamp_behind_camera() { return {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {3, 3, 3}}; }

/// At the origin, looking along +x.
SE3 T_world_forward() { return look_at({0, 0, 0}, {1, 0, 0}); }

Picture picture_of_wall(const Shot& shot) {
  Stage stage({wall()}, {}, {lamp_behind_camera()});
  return Renderer(small_camera()).render(stage, shot);
}

TEST(LookAt, PointsTheOpticalAxisAndKeepsTheImageLevel) {
  const SE3 T_world_camera = look_at({1, 2, 3}, {4, 2, 3});
  EXPECT_TRUE((T_world_camera * Eigen::Vector3d(0, 0, 2)).isApprox(Eigen::Vector3d(3, 2, 3)));
  EXPECT_TRUE((T_world_camera * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(1, 2, 2)));
}

TEST(Renderer, MeasuresDepthAlongTheOpticalAxis) {
  const Picture picture = picture_of_wall(Shot::still(T_world_forward()));
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(picture.depth_m, &low, &high);
  EXPECT_NEAR(low, 2.0, 1e-4);
  EXPECT_NEAR(high, 2.0, 1e-4);
  EXPECT_EQ(picture.tags.at<std::uint16_t>(10, 20), 7);
  EXPECT_EQ(picture.returns_depth.at<std::uint8_t>(10, 20), 0);
  EXPECT_NEAR(picture.facing.at<float>(23, 31), 1.0F, 1e-3F);
  EXPECT_GT(picture.radiance.at<cv::Vec3f>(23, 31)[0], 0.1F);
  EXPECT_NEAR(cv::norm(picture.motion_px, cv::NORM_INF), 0.0, 1e-4);
}

TEST(Renderer, LeavesPixelsThatSeeNothingEmpty) {
  const Picture picture = picture_of_wall(Shot::still(look_at({0, 0, 0}, {-1, 0, 0})));
  EXPECT_EQ(cv::countNonZero(picture.depth_m), 0);
  EXPECT_EQ(cv::countNonZero(picture.tags), 0);
}

TEST(Renderer, TellsHowFarPixelsMoveWhileTheShutterIsOpen) {
  Shot shot = Shot::still(T_world_forward());
  shot.T_world_open = look_at({0, 0.01, 0}, {1, 0.01, 0});
  shot.T_world_close = look_at({0, -0.01, 0}, {1, -0.01, 0});
  const Picture picture = picture_of_wall(shot);
  // The camera moves 2 cm to its right (-y): the wall at 2 m moves fx * 0.02 / 2 to the left.
  EXPECT_NEAR(picture.motion_px.at<cv::Vec2f>(23, 31)[0], -0.6F, 1e-3F);
  EXPECT_NEAR(picture.motion_px.at<cv::Vec2f>(23, 31)[1], 0.0F, 1e-3F);
}

TEST(Renderer, ReadsRowsOneAfterTheOther) {
  Shot shot = Shot::still(T_world_forward());
  shot.T_world_first_row = look_at({-0.5, 0, 0}, {1, 0, 0});
  shot.T_world_last_row = look_at({0.5, 0, 0}, {1, 0, 0});
  const Picture picture = picture_of_wall(shot);
  EXPECT_NEAR(picture.depth_m.at<float>(0, 10), 2.5F, 1e-3F);
  EXPECT_NEAR(picture.depth_m.at<float>(47, 10), 1.5F, 1e-3F);
}

TEST(Renderer, UsesTheLensDistortion) {
  CameraModel camera = small_camera();
  camera.distortion = {-0.2, 0.05, 0.0, 0.0, 0.0};
  Part square{.mesh = {}, .tag = 5};  // covers the upper left of the view up to an ideal pixel
  square.mesh.append(make_box({0.1F, 4, 4}, {}),
                     SE3(Eigen::Quaterniond::Identity(), {2.05, 2.0 + 0.7, 0.4}));
  Stage stage({square}, {}, {lamp_behind_camera()});
  const auto edge_column = [&](const CameraModel& model) {
    const Picture picture = Renderer(model).render(stage, Shot::still(T_world_forward()));
    return cv::countNonZero(picture.tags.row(2));
  };
  // Barrel distortion draws the edge towards the middle: more of the square is in view.
  EXPECT_GT(edge_column(camera), edge_column(small_camera()));
}

TEST(Renderer, GivesTheSameBytesAgain) {
  const Shot shot = Shot::still(look_at({0, 0.3, 0.2}, {2, -1, 0}));
  const Picture once = picture_of_wall(shot);
  const Picture again = picture_of_wall(shot);
  EXPECT_EQ(cv::norm(once.radiance, again.radiance, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(once.depth_m, again.depth_m, cv::NORM_INF), 0.0);
}

TEST(Preview, ShowsAModelBrightBeforeADarkGround) {
  const cv::Mat image =
      render_preview(make_box({1, 1, 1}, {}),
                     {.eye_m = {3, 2, 2}, .target_m = {0, 0, 0.5}, .size = cv::Size(80, 60)});
  ASSERT_EQ(image.type(), CV_8UC3);
  EXPECT_GT(image.at<cv::Vec3b>(30, 40)[1], 60);
  EXPECT_EQ(image.at<cv::Vec3b>(2, 2)[1], 0);
}

TEST(ToSrgb, CompressesWhatIsTooBright) {
  const cv::Mat light = (cv::Mat_<cv::Vec3f>(1, 3) << cv::Vec3f::all(0.0F), cv::Vec3f::all(0.5F),
                         cv::Vec3f::all(50.0F));
  const cv::Mat codes = to_srgb(light);
  EXPECT_EQ(codes.at<cv::Vec3b>(0, 0)[0], 0);
  EXPECT_NEAR(codes.at<cv::Vec3b>(0, 1)[0], 188, 1);
  EXPECT_EQ(codes.at<cv::Vec3b>(0, 2)[0], 255);
}

}  // namespace
}  // namespace tsg::render
