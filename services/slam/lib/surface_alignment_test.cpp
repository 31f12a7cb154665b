#include "services/slam/lib/surface_alignment.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "services/slam/lib/features.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

/// Plane of the points with normal . p = distance, in the world.
struct Plane {
  Eigen::Vector3d normal;
  double distance = 0.0;
};

const std::vector<Plane> kWall = {{{0.0, 0.0, 1.0}, 2.5}};
/// A corner of a room: wall, wall and floor.
const std::vector<Plane> kCorner = {
    {{0.0, 0.0, 1.0}, 2.5}, {{1.0, 0.0, 0.2}, 1.2}, {{0.0, 1.0, 0.1}, 0.9}};

/// What a camera sees that looks at the nearest of `planes` along each ray.
RgbdFrame see(const std::vector<Plane>& planes, const SE3& T_world_camera) {
  RgbdFrame frame{.camera = synthetic::camera(),
                  .depth_units_per_metre = synthetic::kDepthUnits,
                  .colour = {},
                  .depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(0))};
  for (int y = 0; y < frame.depth.rows; ++y) {
    for (int x = 0; x < frame.depth.cols; ++x) {
      const Eigen::Vector3d ray = T_world_camera.rotation() * frame.camera.unproject({x, y}, 1.0);
      double nearest = std::numeric_limits<double>::max();
      for (const Plane& plane : planes) {
        const double depth = (plane.distance - plane.normal.dot(T_world_camera.translation())) /
                             plane.normal.dot(ray);
        if (depth > 0.0) nearest = std::min(nearest, depth);
      }
      frame.depth.at<std::uint16_t>(y, x) =
          cv::saturate_cast<std::uint16_t>(nearest * synthetic::kDepthUnits);
    }
  }
  return frame;
}

const SlamConfig kConfig;
const ObservationModel kSurfaceModel(synthetic::camera(), kConfig);

PatchGrid patches(const RgbdFrame& frame, const cv::Mat& verdicts = {}) {
  return {synthetic::camera(), sample_surface(frame, verdicts, kConfig.features), kConfig.features};
}

TEST(SurfaceAlignment, FindsALargeMotionInACornerOfARoomFromTheShapeAlone) {
  const SE3 T_reference_camera = synthetic::pose_at(0.15, -0.08, 0.1, 0.12);
  const auto alignment = align_surfaces(kSurfaceModel, patches(see(kCorner, SE3())),
                                        patches(see(kCorner, T_reference_camera)), SE3());
  ASSERT_TRUE(alignment);
  const SE3 error = alignment->T_camera_reference * T_reference_camera;
  EXPECT_LT(error.translation().norm(), 0.005);
  EXPECT_LT(error.angle(), 0.003);
  EXPECT_GT(alignment->overlap, 0.7);
  EXPECT_GT(alignment->agreement, 0.95);
}

TEST(SurfaceAlignment, SaysThatAWallLetsTheCameraSlide) {
  const SE3 T_reference_camera = synthetic::pose_at(0.0, 0.0, 0.1, 0.05);
  const auto alignment = align_surfaces(kSurfaceModel, patches(see(kWall, SE3())),
                                        patches(see(kWall, T_reference_camera)), SE3());
  ASSERT_TRUE(alignment);
  const SE3 T_reference_found = alignment->T_camera_reference.inverse();
  EXPECT_NEAR(T_reference_found.translation().z(), 0.1, 0.003);
  EXPECT_NEAR(T_reference_found.angle(), 0.05, 0.003);
  const auto weight = alignment->information.diagonal();
  EXPECT_LT(weight(1), 1e-3 * weight(2)) << "up and down along the wall";
}

TEST(SurfaceAlignment, GivesNothingWithoutDepth) {
  RgbdFrame blind = see(kCorner, SE3());
  blind.depth = cv::Scalar(0);
  EXPECT_FALSE(align_surfaces(kSurfaceModel, patches(see(kCorner, SE3())), patches(blind), SE3()));
  EXPECT_FALSE(align_surfaces(kSurfaceModel, patches(blind), patches(see(kCorner, SE3())), SE3()));
}

TEST(Surface, HasPatchesInThePlanesThatAreSeen) {
  const PatchGrid grid = patches(see(kWall, SE3()));
  EXPECT_GT(grid.patches().size(), 7000U);
  for (const SurfacePatch& patch : grid.patches()) {
    ASSERT_NEAR(patch.point.z(), 2.5, 0.002);
    ASSERT_LT((patch.normal + Eigen::Vector3d::UnitZ()).norm(), 0.02);
  }
  const SurfacePatch* middle = grid.find({319.5, 239.5});
  ASSERT_NE(middle, nullptr);
  EXPECT_LT(middle->point.head<2>().norm(), 0.03);
  EXPECT_EQ(grid.find({-20.0, 10.0}), nullptr);
}

TEST(Surface, LeavesOutWhatMovesAndWhatIsTooFar) {
  const RgbdFrame frame = see(kWall, SE3());
  cv::Mat verdicts(480, 640, CV_8UC1, cv::Scalar(0));
  verdicts(cv::Rect(0, 0, 320, 480)) = static_cast<std::uint8_t>(FeatureVerdict::kDynamic);
  const Surface half = sample_surface(frame, verdicts, kConfig.features);
  EXPECT_EQ(half.at(10, 40), 0.0F);
  EXPECT_NEAR(half.at(90, 40), 0.4F, 1e-3F);
  FeatureConfig near_only;
  near_only.max_depth_m = 2.0;
  EXPECT_EQ(sample_surface(frame, {}, near_only).at(90, 40), 0.0F);
}

}  // namespace
}  // namespace tsg
