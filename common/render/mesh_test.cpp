#include "common/render/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/render/shapes.hpp"

namespace tsg::render {
namespace {

float area_of(const Mesh& mesh) {
  float area = 0.0F;
  for (const Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    area += 0.5F * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
  }
  return area;
}

float longest_edge(const Mesh& mesh) {
  float longest = 0.0F;
  for (const Triangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, (mesh.points[triangle.corners.at(i)] -
                                   mesh.points[triangle.corners.at((i + 1) % 3)])
                                      .norm());
    }
  }
  return longest;
}

/// Volume inside a closed surface; positive where its faces look outwards.
float volume_of(const Mesh& mesh) {
  float volume = 0.0F;
  for (const Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    volume += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6.0F;
  }
  return volume;
}

/// Whether each corner's normal looks to the side from which its triangle is seen.
void expect_normals_outwards(const Mesh& mesh) {
  for (const Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    const Eigen::Vector3f face =
        (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    if (face.norm() < 1e-9F) continue;
    for (const std::uint32_t corner : triangle.corners) {
      EXPECT_NEAR(mesh.normals[corner].norm(), 1.0F, 1e-4F);
      EXPECT_GT(mesh.normals[corner].dot(face), 0.0F);
    }
  }
}

TEST(Mesh, AppendedPartsAreMovedAndKeepTheirMaterials) {
  Mesh mesh = make_box({1, 1, 1}, {.gloss = 0.25F});
  const std::size_t points = mesh.points.size();
  const SE3 T_mesh_part(
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ())),
      {5, 0, 0});
  mesh.append(make_picture(2.0F, 1.0F, {.emission = 3.0F}), T_mesh_part);
  ASSERT_EQ(mesh.points.size(), points + 4);
  EXPECT_TRUE(mesh.points[points].isApprox(Eigen::Vector3f(6, 0, 0), 1e-5F));
  EXPECT_TRUE(mesh.normals[points].isApprox(Eigen::Vector3f(0, 1, 0), 1e-5F));
  EXPECT_EQ(mesh.materials[mesh.triangles.back().material].emission, 3.0F);
  EXPECT_EQ(mesh.materials[mesh.triangles.front().material].gloss, 0.25F);
}

TEST(Mesh, SubdivisionKeepsTheSurfaceAndShortensItsEdges) {
  const Mesh box = make_box({2, 1, 0.5F}, {});
  const Mesh fine = subdivided(box, 0.13F);
  EXPECT_LE(longest_edge(fine), 0.13F);
  EXPECT_NEAR(area_of(fine), area_of(box), 1e-3F);
  EXPECT_NEAR(volume_of(fine), 1.0F, 1e-3F);
  EXPECT_EQ(fine.points.size(), fine.normals.size());
  EXPECT_EQ(fine.points.size(), fine.uvs.size());
  expect_normals_outwards(fine);
}

TEST(Mesh, SubdivisionLeavesTrianglesAloneThatHaveNoSize) {
  Mesh box = make_box({2, 1, 0.5F}, {});
  for (Eigen::Vector3f& point : box.points) point.x() = std::nanf("");
  EXPECT_EQ(subdivided(box, 0.13F).triangles.size(), box.triangles.size());
}

TEST(Shapes, BoxesAreClosedAndLookOutwards) {
  const Mesh box = make_box({2, 1, 0.5F}, {});
  EXPECT_NEAR(volume_of(box), 1.0F, 1e-5F);
  expect_normals_outwards(box);
}

TEST(Shapes, RoundedBoxStaysWithinItsSizeAndLosesItsCorners) {
  const Mesh box = make_rounded_box({0.6F, 0.4F, 0.2F}, 0.05F, {});
  for (const Eigen::Vector3f& point : box.points) {
    EXPECT_LE(std::abs(point.x()), 0.3F + 1e-5F);
    EXPECT_LE(std::abs(point.y()), 0.2F + 1e-5F);
    EXPECT_GE(point.z(), -1e-5F);
    EXPECT_LE(point.z(), 0.2F + 1e-5F);
  }
  const float volume = volume_of(box);
  EXPECT_LT(volume, 0.6F * 0.4F * 0.2F);
  EXPECT_GT(volume, 0.8F * 0.6F * 0.4F * 0.2F);
}

TEST(Shapes, TubesAndTurnedShapesLookOutwards) {
  const Mesh bar = make_bar({0, 0, 0}, {1, 2, 3}, 0.1F, {});
  EXPECT_GT(volume_of(bar), 0.0F);
  const Mesh cone = make_turned({{0.0F, 0.0F}, {0.5F, 0.0F}, {0.0F, 1.0F}}, 64, {});
  EXPECT_NEAR(volume_of(cone), std::numbers::pi_v<float> * 0.25F / 3.0F, 0.005F);
}

TEST(Shapes, PictureShowsItsTextureUprightToWhoStandsBeforeIt) {
  const Mesh picture = make_picture(2.0F, 1.0F, {});
  // Who looks along -x has +y on the right.
  for (std::size_t i = 0; i < picture.points.size(); ++i) {
    EXPECT_FLOAT_EQ(picture.uvs[i].x(), picture.points[i].y() < 0.0F ? 0.0F : 1.0F);
    EXPECT_FLOAT_EQ(picture.uvs[i].y(), picture.points[i].z() > 0.5F ? 0.0F : 1.0F);
    EXPECT_TRUE(picture.normals[i].isApprox(Eigen::Vector3f::UnitX()));
  }
}

}  // namespace
}  // namespace tsg::render
