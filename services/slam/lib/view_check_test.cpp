#include "services/slam/lib/view_check.hpp"

#include <gtest/gtest.h>

#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

/// The same view with an image of another size.
RgbdFrame resized(const RgbdFrame& frame, int width, int height) {
  RgbdFrame other = frame;
  other.camera = frame.camera.resized(width, height);
  cv::resize(frame.colour, other.colour, {width, height});
  cv::resize(frame.depth, other.depth, {width, height}, 0.0, 0.0, cv::INTER_NEAREST);
  return other;
}

class SurfacesFit : public testing::TestWithParam<int> {
 protected:
  /// Two cameras side by side before the same wall, `metres` apart: each sees 3.66 m of it.
  bool fit(double metres) {
    const synthetic::Scene wall({{.z = 3.0, .corner = {-4.0, -3.0}, .extent = {8.0, 6.0}}});
    const SE3 T_a_b = synthetic::pose_at(metres, 0.0, 0.0);
    const RgbdFrame a = resized(wall.render(0, SE3()), GetParam(), GetParam() * 3 / 4);
    const RgbdFrame b = resized(wall.render(1, T_a_b), GetParam(), GetParam() * 3 / 4);
    Features features_a;
    Features features_b;
    features_a.surface = sample_surface(a, {}, FeatureConfig{});
    features_b.surface = sample_surface(b, {}, FeatureConfig{});
    return do_surfaces_fit(ObservationModel(a.camera, SlamConfig{}), features_a, features_b,
                           T_a_b.inverse(), 0.1);
  }
};

TEST_P(SurfacesFit, WhereAFifthOfTheImageIsSeenByBoth) { EXPECT_TRUE(fit(2.9)); }

TEST_P(SurfacesFit, NotWhereHardlyAnythingIs) { EXPECT_FALSE(fit(3.55)); }

INSTANTIATE_TEST_SUITE_P(AnySizeOfImage, SurfacesFit, testing::Values(320, 640, 1280));

}  // namespace
}  // namespace tsg
