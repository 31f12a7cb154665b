#include "services/slam/lib/surface_agreement.hpp"

#include <gtest/gtest.h>

#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

constexpr double kSigma = 0.003;

Surface seen_from(const synthetic::Scene& scene, const SE3& T_world_camera) {
  return sample_surface(scene.render(0, T_world_camera), {}, FeatureConfig{});
}

TEST(SurfaceAgreement, TwoViewsOfOneSceneAgree) {
  const auto room = synthetic::Scene::room();
  const SE3 T_world_b = synthetic::pose_at(0.3, 0.1, 0.2, -0.15);
  const auto agreement = compare_surfaces(synthetic::camera(), seen_from(room, SE3()),
                                          seen_from(room, T_world_b), T_world_b.inverse(), kSigma);
  EXPECT_GT(agreement.agreeing, 1000);
  EXPECT_LT(agreement.contradiction(), 0.03);
}

TEST(SurfaceAgreement, SeesThroughWhatIsMissing) {
  const auto room = synthetic::Scene::room();
  const synthetic::Scene bare({{.z = 3.0, .corner = {-4.0, -3.0}, .extent = {8.0, 6.0}}});
  const auto there = compare_surfaces(synthetic::camera(), seen_from(room, SE3()),
                                      seen_from(bare, SE3()), SE3(), kSigma);
  EXPECT_GT(there.contradiction(), 0.15);
  const auto back = compare_surfaces(synthetic::camera(), seen_from(bare, SE3()),
                                     seen_from(room, SE3()), SE3(), kSigma);
  EXPECT_GT(back.hidden, 300);
  EXPECT_LT(back.contradiction(), 0.03) << "what is in front hides, and does not contradict";
}

TEST(SurfaceAgreement, SaysNothingWithoutOverlap) {
  const auto room = synthetic::Scene::room();
  const SE3 T_b_a = synthetic::pose_at(0.0, 0.0, 0.0, 3.1);
  const auto agreement = compare_surfaces(synthetic::camera(), seen_from(room, SE3()),
                                          seen_from(room, SE3()), T_b_a, kSigma);
  EXPECT_EQ(agreement.agreeing, 0);
  EXPECT_EQ(agreement.contradiction(), 1.0);
}

}  // namespace
}  // namespace tsg
