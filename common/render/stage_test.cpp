#include "common/render/stage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "common/render/lamp_light.hpp"
#include "common/render/sampling.hpp"
#include "common/render/shapes.hpp"

namespace tsg::render {
namespace {

Lamp lamp_above(float z_m) {
  return {{0, 0, z_m}, {0.2F, 0, 0}, {0, 0.2F, 0}, {0, 0, -1}, {10, 10, 10}};
}

/// A floor of 6 x 6 m with its top at z = 0.
Part floor_part() {
  Part part{.mesh = {}, .tag = 1};
  part.mesh.append(make_box({6, 6, 0.1F}, {}), SE3(Eigen::Quaterniond::Identity(), {0, 0, -0.1}));
  return part;
}

Part ball_part() { return {make_turned({{0.0F, -0.3F}, {0.3F, 0.0F}, {0.0F, 0.3F}}, 16, {}), 2}; }

/// Light on what a ray straight down at (x, y) meets.
float light_below(Stage& stage, float x, float y) {
  const std::array<Ray, 1> ray{Ray{{x, y, 0.05F}, {0, 0, -1}}};
  std::array<Sighting, 1> seen;
  stage.look(ray, seen);
  stage.light_up(seen);
  return stage.light(seen[0]).x();
}

TEST(LampLight, FallsWithTheSquareOfTheDistance) {
  const RayScene nothing(RayScene::Use::kFixed);
  const SurfacePoint near{{0, 0, 0}, {0, 0, 1}};
  const float at_2m = lamp_light(lamp_above(2), near, nothing, 16, 0).x();
  const float at_4m = lamp_light(lamp_above(4), near, nothing, 16, 0).x();
  EXPECT_NEAR(at_2m / at_4m, 4.0F, 0.1F);
  // A small lamp of radiance L and area A at distance d: L A / (pi d^2) of a white surface.
  EXPECT_NEAR(at_4m, 10.0F * 0.16F / (std::numbers::pi_v<float> * 16.0F), 1e-3F);
}

TEST(LampLight, ReachesNoSurfaceThatLooksAwayAndNoneBehindTheLamp) {
  const RayScene nothing(RayScene::Use::kFixed);
  EXPECT_EQ(lamp_light(lamp_above(2), {{0, 0, 0}, {0, 0, -1}}, nothing, 16, 0).x(), 0.0F);
  EXPECT_EQ(lamp_light(lamp_above(2), {{0, 0, 3}, {0, 0, 1}}, nothing, 16, 0).x(), 0.0F);
}

TEST(Sampling, SpreadsEvenlyOverTheSquareAndTheHemisphere) {
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
  constexpr int kCount = 256;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector2f where = spread_point(i, kCount, 7);
    ASSERT_GE(where.minCoeff(), 0.0F);
    ASSERT_LE(where.maxCoeff(), 1.0F);
    mean += where / kCount;
    direction += cosine_direction(Eigen::Vector3f::UnitX(), where) / kCount;
  }
  EXPECT_NEAR(mean.x(), 0.5F, 0.02F);
  EXPECT_NEAR(mean.y(), 0.5F, 0.02F);
  EXPECT_NEAR(direction.x(), 2.0F / 3.0F, 0.02F);  // the mean cosine under the cosine law
  EXPECT_NEAR(direction.tail<2>().norm(), 0.0F, 0.02F);
}

TEST(Stage, FixedPartsThrowShadowsAndGiveLightBack) {
  Part roof{.mesh = {}, .tag = 3};
  roof.mesh.append(make_box({1, 1, 0.05F}, {}), SE3(Eigen::Quaterniond::Identity(), {0, 0, 1}));
  Stage stage({floor_part(), roof}, {}, {lamp_above(2.5F)});
  const float under_roof = light_below(stage, 0.0F, 0.0F);
  const float beside = light_below(stage, 1.8F, 0.0F);
  EXPECT_GT(under_roof, 0.0F) << "light bounces off the floor and the roof's underside";
  EXPECT_LT(under_roof, 0.5F * beside);
}

TEST(Stage, BodiesThrowShadowsWhereTheyAreNow) {
  const Part ball = ball_part();
  Stage stage({floor_part()}, {ball}, {lamp_above(2.5F)});
  const auto put_at = [&](float x) {
    std::vector<Eigen::Vector3f> points = ball.mesh.points;
    for (Eigen::Vector3f& point : points) point += Eigen::Vector3f(x, 0, 0.6F);
    const std::vector<Eigen::Vector3f> still(points.size(), Eigen::Vector3f::Zero());
    stage.pose_body(0, points, ball.mesh.normals, still);
    stage.update();
  };
  put_at(0.0F);
  const float shaded = light_below(stage, 0.0F, 0.0F);
  put_at(2.0F);
  const float open = light_below(stage, 0.0F, 0.0F);
  EXPECT_LT(shaded, 0.5F * open);
}

TEST(Stage, LooksAtTheNearerOfBodyAndFixedPart) {
  const Part ball = ball_part();
  Stage stage({floor_part()}, {ball}, {lamp_above(2.5F)});
  const std::array<Ray, 2> rays{Ray{{0, 0, 3}, {0, 0, -1}}, Ray{{1, 0, 3}, {0, 0, -1}}};
  std::array<Sighting, 2> seen;
  stage.look(rays, seen);
  EXPECT_TRUE(seen[0].is_body);
  EXPECT_NEAR(seen[0].hit.distance, 2.7F, 1e-4F);
  EXPECT_FALSE(seen[1].is_body);
  EXPECT_NEAR(seen[1].hit.distance, 3.0F, 1e-4F);
}

TEST(BouncedLightField, IsDarkWhereNothingShinesAndBrighterTowardsALitWall) {
  const Layer floor = make_layer({floor_part()}, RayScene::Use::kFixed, 0.2F);
  const BakedLight light = bake_light(floor, {lamp_above(2.5F)});
  const BouncedLightField field(floor, light);
  const float down = field.at({{0, 0, 0.5F}, {0, 0, -1}}).x();
  const float up = field.at({{0, 0, 0.5F}, {0, 0, 1}}).x();
  EXPECT_GT(down, 0.0F);
  EXPECT_EQ(up, 0.0F) << "there is no ceiling that gives light back";
}

TEST(Openness, IsLessInACorner) {
  Mesh corner = make_box({1, 1, 0.1F}, {});
  corner.append(make_box({0.1F, 1, 1}, {}));
  const Layer body = make_layer({{subdivided(corner, 0.1F), 0}}, RayScene::Use::kFixed, 0.0F);
  const std::vector<float> openness = bake_openness(body);
  EXPECT_EQ(openness.size(), body.mesh.points.size());
  EXPECT_LT(*std::ranges::min_element(openness), 0.7F);
  EXPECT_EQ(*std::ranges::max_element(openness), 1.0F);
}

}  // namespace
}  // namespace tsg::render
