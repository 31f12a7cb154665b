#include "common/dataset/tum_cameras.hpp"

#include <gtest/gtest.h>

#include "tests/support/shared_dir.hpp"

namespace tsg {
namespace {

TEST(TumBenchmarkCamera, IsToldByTheNameOfTheSequence) {
  const auto first = tum_benchmark_camera("rgbd_dataset_freiburg1_desk");
  const auto second = tum_benchmark_camera("rgbd_dataset_freiburg2_pioneer_360");
  const auto third = tum_benchmark_camera("rgbd_dataset_freiburg3_walking_xyz");
  ASSERT_TRUE(first && second && third);
  EXPECT_DOUBLE_EQ(first->model.fx, 517.3);
  EXPECT_DOUBLE_EQ(second->model.cy, 249.7);
  EXPECT_DOUBLE_EQ(third->model.fy, 539.2);
  EXPECT_TRUE(first->model.is_distorted());
  EXPECT_TRUE(second->model.is_distorted());
  EXPECT_FALSE(third->model.is_distorted());
  for (const auto& camera : {first, second, third}) {
    EXPECT_TRUE(camera->model.problems().empty());
    EXPECT_DOUBLE_EQ(camera->depth_units_per_metre, 5000.0);
  }
}

TEST(TumBenchmarkCamera, IsUnknownForOtherNames) {
  for (const char* name : {"", "walking_xyz", "freiburg", "rgbd_dataset_freiburg",
                           "rgbd_dataset_freiburg4_xyz", "my_rgbd_dataset_freiburg1_xyz"}) {
    EXPECT_FALSE(tum_benchmark_camera(name)) << name;
  }
}

TEST(TumBenchmarkCamera, AgreesWithTheFilesThatComeWithFragments) {
  TSG_REQUIRE_SHARED("data/tum_bits/fr1_desk_9");
  const auto folder = test::shared_dir() / "data/tum_bits";
  const auto first = value_or_throw(read_camera_file(folder / "fr1_desk_9/camera.yaml"));
  const auto third = value_or_throw(read_camera_file(folder / "fr3_cabinet_sub58/camera.yaml"));
  EXPECT_EQ(tum_benchmark_camera("rgbd_dataset_freiburg1_desk")->model, first.model);
  EXPECT_EQ(tum_benchmark_camera("rgbd_dataset_freiburg3_cabinet")->model, third.model);
}

}  // namespace
}  // namespace tsg
