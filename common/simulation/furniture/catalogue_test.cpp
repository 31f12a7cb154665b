#include "common/simulation/furniture/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

namespace tsg::simulation {
namespace {

struct Extent {
  Eigen::Vector3f low;
  Eigen::Vector3f high;
};

Extent extent_of(const render::Mesh& mesh) {
  Extent extent{mesh.points.front(), mesh.points.front()};
  for (const Eigen::Vector3f& point : mesh.points) {
    extent.low = extent.low.cwiseMin(point);
    extent.high = extent.high.cwiseMax(point);
  }
  return extent;
}

bool is_same(const render::Texture& a, const render::Texture& b) {
  for (int i = 0; i < 400; ++i) {  // places all over the picture
    const auto step = static_cast<float>(i);
    const Eigen::Vector2f uv(0.37F * step, 0.0025F * step);
    if (a.sample(uv, 0.0F) != b.sample(uv, 0.0F)) return false;
  }
  return true;
}

bool is_same(const render::Mesh& a, const render::Mesh& b) {
  const auto same_triangle = [](const render::Triangle& one, const render::Triangle& other) {
    return one.corners == other.corners && one.material == other.material;
  };
  const auto same_material = [](const render::Material& one, const render::Material& other) {
    if ((one.texture == nullptr) != (other.texture == nullptr)) return false;
    const bool same_picture = one.texture == nullptr || is_same(*one.texture, *other.texture);
    return same_picture && one.colour_bgr == other.colour_bgr && one.gloss == other.gloss &&
           one.emission == other.emission && one.returns_depth == other.returns_depth;
  };
  return a.points == b.points && a.normals == b.normals && a.uvs == b.uvs &&
         std::ranges::equal(a.triangles, b.triangles, same_triangle) &&
         std::ranges::equal(a.materials, b.materials, same_material);
}

/// Every type, in a few looks.
class Furniture : public testing::TestWithParam<std::string> {
 protected:
  static constexpr std::uint64_t kLooks = 3;
  [[nodiscard]] static FurnitureModel make(std::uint64_t look) {
    return make_furniture(GetParam(), look);
  }
};

TEST_P(Furniture, HasASoundMesh) {
  for (std::uint64_t look = 1; look <= kLooks; ++look) {
    const render::Mesh mesh = make(look).mesh;
    ASSERT_FALSE(mesh.triangles.empty());
    ASSERT_EQ(mesh.normals.size(), mesh.points.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      ASSERT_TRUE(mesh.points[i].allFinite()) << "point " << i << ", look " << look;
      ASSERT_TRUE(mesh.uvs[i].allFinite()) << "uv " << i << ", look " << look;
      ASSERT_NEAR(mesh.normals[i].norm(), 1.0F, 1e-3F) << "normal " << i << ", look " << look;
    }
    for (const render::Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle.corners) ASSERT_LT(corner, mesh.points.size());
      ASSERT_LT(triangle.material, mesh.materials.size());
    }
  }
}

TEST_P(Furniture, FacesAndNormalsAgree) {
  const render::Mesh mesh = make(1).mesh;
  std::size_t against = 0;
  for (const render::Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    const Eigen::Vector3f face =
        (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    const Eigen::Vector3f normal = mesh.normals[a] + mesh.normals[b] + mesh.normals[c];
    if (face.norm() > 1e-9F && face.dot(normal) < -1e-3F * face.norm()) ++against;
  }
  // Cables bend so sharply that a few of their faces fold over.
  EXPECT_LE(against, mesh.triangles.size() / 25) << "of " << mesh.triangles.size();
}

TEST_P(Furniture, StandsOnItsBase) {
  for (std::uint64_t look = 1; look <= kLooks; ++look) {
    EXPECT_NEAR(extent_of(make(look).mesh).low.z(), 0.0F, 0.012F) << "look " << look;
  }
}

TEST_P(Furniture, IsTheSameForTheSameLookOnly) {
  const FurnitureModel first = make(3);
  EXPECT_TRUE(is_same(first.mesh, make(3).mesh));
  EXPECT_FALSE(is_same(first.mesh, make(4).mesh));
}

TEST_P(Furniture, KnowsItsSize) {
  const FurnitureModel model = make(2);
  const Extent extent = extent_of(model.mesh);
  EXPECT_NEAR(2.0 * model.half_size_m.x(), extent.high.x() - extent.low.x(), 1e-5);
  EXPECT_NEAR(2.0 * model.half_size_m.y(), extent.high.y() - extent.low.y(), 1e-5);
  EXPECT_LT(model.half_size_m.maxCoeff(), 1.5);
  EXPECT_LT(extent.high.z(), 2.5F);
}

TEST_P(Furniture, CarriesThingsOnAFaceAtItsTop) {
  for (std::uint64_t look = 1; look <= kLooks; ++look) {
    const FurnitureModel model = make(look);
    if (model.top_m == 0.0) continue;
    const auto at_top = std::ranges::count_if(model.mesh.points, [&](const Eigen::Vector3f& point) {
      return std::abs(double{point.z()} - model.top_m) < 0.012;
    });
    EXPECT_GT(at_top, 0) << "look " << look << ": nothing of the mesh lies at " << model.top_m;
  }
}

TEST_P(Furniture, SeatsAreAtTheHeightOfAKnee) {
  for (std::uint64_t look = 1; look <= kLooks; ++look) {
    const FurnitureModel model = make(look);
    if (!model.seat) continue;
    EXPECT_GT(model.seat->centre_m.z(), 0.38);
    EXPECT_LT(model.seat->centre_m.z(), 0.52);
    EXPECT_LT(std::abs(model.seat->centre_m.x()), model.half_size_m.x());
    EXPECT_LT(std::abs(model.seat->centre_m.y()), model.half_size_m.y());
  }
}

TEST_P(Furniture, KeepsToItsBudgetOfTriangles) {
  for (std::uint64_t look = 1; look <= kLooks; ++look) {
    EXPECT_LT(make(look).mesh.triangles.size(), 12000U) << "look " << look;
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue,
                         Furniture,
                         testing::ValuesIn(furniture_types()),
                         [](const auto& each) { return each.param; });

TEST(Catalogue, IsSortedAndHasEveryTypeOnce) {
  const std::vector<std::string> types = furniture_types();
  EXPECT_TRUE(std::ranges::is_sorted(types));
  EXPECT_EQ(std::set<std::string>(types.begin(), types.end()).size(), types.size());
}

TEST(Catalogue, NamesClassesAsCocoDoes) {
  EXPECT_EQ(make_furniture("desk", 1).class_name, "dining table");
  EXPECT_EQ(make_furniture("monitor", 1).class_name, "tv");
  EXPECT_EQ(make_furniture("big_plant", 1).class_name, "potted plant");
  EXPECT_EQ(make_furniture("fridge", 1).class_name, "refrigerator");
}

TEST(Catalogue, LetsPeopleSitOnEveryChairAndCouch) {
  for (const char* type : {"office_chair", "wooden_chair", "armchair", "couch"}) {
    EXPECT_TRUE(make_furniture(type, 1).seat.has_value()) << type;
  }
}

}  // namespace
}  // namespace tsg::simulation
