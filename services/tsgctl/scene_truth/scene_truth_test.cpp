#include "services/tsgctl/scene_truth/scene_truth.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using testing::HasSubstr;

SceneTruth small_truth() {
  SceneTruth truth;
  truth.objects = {{.id = 4,
                    .class_name = "chair",
                    .name = "chair_a",
                    .boxes = {{1'000'000'000, {1.0F, 2.0F, 0.5F}, {0.6F, 0.6F, 1.0F}, 0.5F},
                              {2'500'000'000, {3.0F, 2.0F, 0.5F}, {0.6F, 0.6F, 1.0F}, 0.7F}}}};
  truth.swept_by_people.insert({1.0F, 1.0F, 1.0F});
  truth.surfaces.insert({2.0F, 2.0F, 2.0F});
  return truth;
}

TEST(SceneTruth, AnObjectIsWhereItWasPutLast) {
  const SceneTruth truth = small_truth();
  const TrueObject& chair = truth.objects.front();
  EXPECT_FLOAT_EQ(chair.box_at(0).centre_m.x(), 1.0F);
  EXPECT_FLOAT_EQ(chair.box_at(2'499'999'999).centre_m.x(), 1.0F);
  EXPECT_FLOAT_EQ(chair.box_at(2'500'000'000).centre_m.x(), 3.0F);
}

TEST(SceneTruth, ComesBackFromItsFiles) {
  const test::TempFolder folder;
  EXPECT_FALSE(has_scene_truth(folder.path()));
  SceneTruth truth = small_truth();
  ASSERT_TRUE(write_scene_truth(folder.path(), truth));
  EXPECT_TRUE(has_scene_truth(folder.path()));
  const auto read = read_scene_truth(folder.path());
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->objects.size(), 1U);
  const TrueObject& chair = read->objects.front();
  EXPECT_EQ(chair.id, 4);
  EXPECT_EQ(chair.class_name, "chair");
  ASSERT_EQ(chair.boxes.size(), 2U);
  EXPECT_EQ(chair.boxes[1].from_ns, 2'500'000'000);
  EXPECT_NEAR(chair.boxes[1].yaw_rad, 0.7F, 1e-4F);
  EXPECT_TRUE(chair.boxes[1].size_m.isApprox(Eigen::Vector3f(0.6F, 0.6F, 1.0F)));
  EXPECT_TRUE(read->swept_by_people.contains({1.0F, 1.0F, 1.0F}));
  EXPECT_TRUE(read->surfaces.contains({2.0F, 2.0F, 2.0F}));
}

TEST(SceneTruth, NamesTheFileThatIsAbsentOrDamaged) {
  const test::TempFolder folder;
  SceneTruth truth = small_truth();
  ASSERT_TRUE(write_scene_truth(folder.path(), truth));
  std::filesystem::remove(folder / "truth_people.bt");
  const auto absent = read_scene_truth(folder.path());
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ExitCode::kMissingInput);
  EXPECT_THAT(absent.error().message, HasSubstr("truth_people.bt"));
  for (const char* text : {"{", "{}", R"({"objects": [{"id": 1}]})",
                           R"({"objects": [{"id": 1, "class": "a", "name": "b", "boxes": []}]})"}) {
    folder.write("truth_objects.json", text);
    const auto damaged = read_scene_truth(folder.path());
    ASSERT_FALSE(damaged) << text;
    EXPECT_EQ(damaged.error().code, ExitCode::kBadData);
    EXPECT_THAT(damaged.error().message, HasSubstr("truth_objects.json"));
  }
}

}  // namespace
}  // namespace tsg
