#include "services/tsgctl/scene_truth/body_volume.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

/// The surface of a box from `low` to `high`: 12 triangles.
class BoxSurface {
 public:
  BoxSurface(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
    for (int corner = 0; corner < 8; ++corner) {
      points_.emplace_back((corner & 1) != 0 ? high.x() : low.x(),
                           (corner & 2) != 0 ? high.y() : low.y(),
                           (corner & 4) != 0 ? high.z() : low.z());
    }
  }
  [[nodiscard]] Surface surface() const {
    return {points_,
            {{0, 1, 3},
             {0, 3, 2},
             {4, 5, 7},
             {4, 7, 6},
             {0, 1, 5},
             {0, 5, 4},
             {2, 3, 7},
             {2, 7, 6},
             {0, 2, 6},
             {0, 6, 4},
             {1, 3, 7},
             {1, 7, 5}}};
  }

 private:
  std::vector<Eigen::Vector3f> points_;
};

const BoxSurface kBox({0.01F, 0.01F, 0.01F}, {0.49F, 0.29F, 0.99F});  // 10 x 6 x 20 voxels

TEST(BodyVolume, ASurfaceIsHollow) {
  VoxelSet voxels(0.05);
  add_surface(kBox.surface(), voxels);
  EXPECT_EQ(voxels.size(), 10U * 6U * 20U - 8U * 4U * 18U);
  EXPECT_FALSE(voxels.contains({0.25F, 0.15F, 0.5F}));
  EXPECT_TRUE(voxels.contains({0.25F, 0.15F, 0.98F}));
}

TEST(BodyVolume, ABodyIsFilled) {
  VoxelSet voxels(0.05);
  add_body(kBox.surface(), voxels);
  EXPECT_EQ(voxels.size(), 10U * 6U * 20U);
}

TEST(BodyVolume, BodiesAddUpAndWhatLiesBetweenThemStaysEmpty) {
  VoxelSet voxels(0.05);
  add_body(kBox.surface(), voxels);
  add_body(BoxSurface({-1.0F, -1.0F, 0.01F}, {-0.51F, -0.51F, 0.04F}).surface(), voxels);
  EXPECT_TRUE(voxels.contains({-0.6F, -0.6F, 0.02F}));
  EXPECT_FALSE(voxels.contains({-0.2F, -0.2F, 0.02F}));
}

TEST(BodyVolume, ABodyWithoutPointsIsNothing) {
  VoxelSet voxels(0.05);
  add_body(Surface{}, voxels);
  EXPECT_EQ(voxels.size(), 0U);
}

}  // namespace
}  // namespace tsg
