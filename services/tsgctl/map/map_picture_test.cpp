#include "services/tsgctl/map/map_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "services/tsgctl/map/map_mesh.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using octomap::ColorOcTree;
using test::TempFolder;
using ::testing::HasSubstr;

constexpr double kResolution = 0.1;  // metres

/// The middle of a leaf.
octomap::point3d leaf_at(int x, int y, int z) {
  const auto middle = [](int i) { return static_cast<float>((i + 0.5) * kResolution); };
  return {middle(x), middle(y), middle(z)};
}

/// A red block of 2 x 1 leaves that stands in free space.
class Block : public ::testing::Test {
 protected:
  Block() : tree_(kResolution) {
    for (int x = -3; x <= 4; ++x) {
      for (int y = -3; y <= 3; ++y) {
        for (int z = -3; z <= 3; ++z) tree_.updateNode(leaf_at(x, y, z), false);
      }
    }
    for (int x : {0, 1}) occupy(x, 0, 0);
  }

  void occupy(int x, int y, int z) {
    tree_.setNodeValue(leaf_at(x, y, z), 3.0F);
    tree_.setNodeColor(tree_.coordToKey(leaf_at(x, y, z)), 220, 20, 20);
  }

  ColorOcTree tree_;
};

TEST_F(Block, ShowsTheSidesThatFaceTheEyeAndNoneBetweenItsLeaves) {
  const render::Mesh mesh = make_map_mesh(tree_, {5.0, 5.0, 5.0});
  EXPECT_EQ(mesh.triangles.size(), 2U * 5U) << "two tops, two of +y, one of +x";
  EXPECT_EQ(mesh.materials.size(), 1U);
  for (const render::Triangle& triangle : mesh.triangles) {
    const auto point = [&](int i) {
      return mesh.points[triangle.corners.at(static_cast<std::size_t>(i))];
    };
    const Eigen::Vector3f outwards = (point(1) - point(0)).cross(point(2) - point(0));
    EXPECT_GT(outwards.dot(mesh.normals[triangle.corners[0]]), 0.0F);
    EXPECT_GT(outwards.dot(Eigen::Vector3f(5.0F, 5.0F, 5.0F) - point(0)), 0.0F);
  }
}

TEST_F(Block, HasItsColourInLinearLight) {
  const render::Mesh mesh = make_map_mesh(tree_, {5.0, 5.0, 5.0});
  EXPECT_NEAR(mesh.materials.at(0).colour_bgr.z(), 0.716F, 0.001F);  // sRGB 220
}

TEST_F(Block, IsNotSeenWhereTheSpaceBesideItIsUnknown) {
  ColorOcTree wall(kResolution);
  wall.updateNode(leaf_at(0, 0, 0), true);
  wall.updateNode(leaf_at(-1, 0, 0), false);  // seen from -x only
  EXPECT_TRUE(make_map_mesh(wall, {5.0, 0.05, 0.05}).triangles.empty());
  EXPECT_EQ(make_map_mesh(wall, {-5.0, 0.05, 0.05}).triangles.size(), 2U);
}

TEST_F(Block, MeasuresWhatAnEyeSees) {
  const double tops_m2 = 2.0 * kResolution * kResolution;
  EXPECT_NEAR(visible_area_m2(tree_, {0.1, 0.05, 1000.0}), tops_m2, 1e-4 * tops_m2);
}

TEST_F(Block, MakesAPictureOfARedThingOnALightGround) {
  const cv::Mat picture = picture_of_map(tree_);
  ASSERT_EQ(picture.size(), cv::Size(1200, 900));
  const auto middle = picture.at<cv::Vec3b>(450, 600);
  EXPECT_GT(middle[2], 2 * middle[1]) << "red";
  const auto corner = picture.at<cv::Vec3b>(5, 5);
  EXPECT_GT(corner[0], 200);
  EXPECT_EQ(corner[0], corner[2]);
}

TEST_F(Block, IsDrawnFromItsFile) {
  const TempFolder folder;
  ASSERT_TRUE(tree_.write((folder / "map.ot").string()));
  const auto drawn = draw_map(folder / "map.ot", folder / "map.png");
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_FALSE(cv::imread((folder / "map.png").string()).empty());
}

TEST(MapPicture, OfAMapThatIsAbsentEmptyOrNoneSaysSo) {
  const TempFolder folder;
  const auto absent = draw_map(folder / "map.ot", folder / "map.png");
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ExitCode::kMissingInput);

  for (const char* content : {"no octree at all", "id ColorOcTree\nsize 99\nres 0.1\ndata\nxx"}) {
    folder.write("map.ot", content);
    const auto broken = draw_map(folder / "map.ot", folder / "map.png");
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().code, ExitCode::kBadData);
    EXPECT_THAT(broken.error().message, HasSubstr("map.ot"));
  }

  ASSERT_TRUE(ColorOcTree(kResolution).write((folder / "map.ot").string()));
  const auto empty = draw_map(folder / "map.ot", folder / "map.png");
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ExitCode::kEmptyInput);
  EXPECT_FALSE(std::filesystem::exists(folder / "map.png"));
}

}  // namespace
}  // namespace tsg
