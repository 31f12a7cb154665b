#include "common/render/ray_scene.hpp"

#include <gtest/gtest.h>

#include <array>

#include "common/render/layer.hpp"
#include "common/render/shapes.hpp"

namespace tsg::render {
namespace {

RayScene box_scene(RayScene::Use use) {
  const Mesh box = make_box({2, 2, 2}, {});
  RayScene scene(use);
  scene.set(box.points, box.triangles);
  return scene;
}

TEST(RayScene, FindsTheFirstSurfaceAndWhereOnIt) {
  const RayScene scene = box_scene(RayScene::Use::kFixed);
  const Mesh box = make_box({2, 2, 2}, {});
  // Eleven rays: more than one packet, and one that is not full.
  std::array<Ray, 11> rays;
  std::array<Hit, 11> hits;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const float y = -0.95F + 0.19F * static_cast<float>(i);
    rays.at(i) = {{5.0F, y, 0.3F}, {-2.0F, 0.0F, 0.0F}};
  }
  scene.cast(rays, hits, RayScene::Likeness::kAlike);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_TRUE(hits.at(i).is_hit());
    EXPECT_NEAR(hits.at(i).distance, 2.0F, 1e-5F) << "distances count in lengths of the direction";
    const Eigen::Vector3f point =
        at_hit(box.triangles[hits.at(i).triangle], hits.at(i), box.points);
    EXPECT_TRUE(point.isApprox(Eigen::Vector3f(1.0F, rays.at(i).origin.y(), 0.3F), 1e-4F));
  }
}

TEST(RayScene, MissesWhatIsBesideOrTooFar) {
  const RayScene scene = box_scene(RayScene::Use::kFixed);
  const std::array<Ray, 2> rays{Ray{{5, 3, 1}, {-1, 0, 0}}, Ray{{5, 0, 1}, {-1, 0, 0}, 3.9F}};
  std::array<Hit, 2> hits;
  scene.cast(rays, hits, RayScene::Likeness::kAlike);
  EXPECT_FALSE(hits[0].is_hit());
  EXPECT_FALSE(hits[1].is_hit());
  EXPECT_FALSE(scene.is_blocked(rays[1]));
  EXPECT_TRUE(scene.is_blocked({{5, 0, 1}, {-1, 0, 0}, 4.1F}));
}

TEST(RayScene, FollowsPointsThatMove) {
  RayScene scene = box_scene(RayScene::Use::kMoving);
  Mesh box = make_box({2, 2, 2}, {});
  for (Eigen::Vector3f& point : box.points) point.x() += 3.0F;
  scene.move(box.points);
  EXPECT_FALSE(scene.is_blocked({{0, 0, 5}, {0, 0, -1}}));
  EXPECT_TRUE(scene.is_blocked({{3, 0, 5}, {0, 0, -1}}));
}

TEST(RayScene, NothingIsHitInAnEmptyOne) {
  const RayScene scene(RayScene::Use::kMoving);
  EXPECT_TRUE(scene.is_empty());
  EXPECT_FALSE(scene.is_blocked({{0, 0, 5}, {0, 0, -1}}));
}

}  // namespace
}  // namespace tsg::render
