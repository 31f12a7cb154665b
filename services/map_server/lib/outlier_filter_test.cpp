#include "services/map_server/lib/outlier_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using testing::HasSubstr;

/// A wall of 2 m x 1 m at x = 2 with a point every centimetre.
Cloud wall() {
  Cloud cloud;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 100; ++j) {
      cloud.push_back({{2.0F, 0.01F * static_cast<float>(i), 0.01F * static_cast<float>(j)},
                       {100, 100, 100},
                       kBackgroundClass,
                       1});
    }
  }
  return cloud;
}

CloudPoint point_at(const Eigen::Vector3f& position) {
  return {position, {1, 2, 3}, kBackgroundClass, 1};
}

TEST(OutlierFilter, TakesOutWhatFliesBetweenSurfacesAndNothingElse) {
  Cloud cloud = wall();
  const std::size_t of_wall = cloud.size();
  cloud.insert(cloud.begin(), point_at({1.0F, 0.5F, 0.5F}));
  cloud.push_back(point_at({1.2F, 1.5F, 0.3F}));
  cloud.push_back(point_at({1.2F, 1.5F, 0.31F}));  // two in a voxel are still alone
  EXPECT_EQ(OutlierFilter({}).apply(cloud), 3U);
  ASSERT_EQ(cloud.size(), of_wall);
  for (const CloudPoint& point : cloud) EXPECT_EQ(point.position.x(), 2.0F);
}

TEST(OutlierFilter, LeavesASurfaceAloneThatHasNone) {
  Cloud cloud = wall();
  const std::size_t before = cloud.size();
  EXPECT_EQ(OutlierFilter({}).apply(cloud), 0U);
  EXPECT_EQ(cloud.size(), before);
}

TEST(OutlierFilter, KeepsAThinPole) {
  Cloud cloud = wall();
  for (int i = 0; i < 100; ++i) {
    cloud.push_back(point_at({1.0F, 0.5F, 0.01F * static_cast<float>(i)}));
  }
  EXPECT_EQ(OutlierFilter({}).apply(cloud), 0U);
}

TEST(OutlierFilter, DoesNotDependOnHowDenselyASurfaceWasSeen) {
  Cloud cloud = wall();
  for (int i = 0; i < 40; ++i) {  // a floor seen at a grazing angle: a point every 5 cm
    for (int j = 0; j < 40; ++j) {
      cloud.push_back(
          point_at({0.05F * static_cast<float>(i), 0.05F * static_cast<float>(j) + 0.02F, -0.3F}));
    }
  }
  EXPECT_EQ(OutlierFilter({}).apply(cloud), 0U);
}

TEST(OutlierFilter, DoesNothingWhereItIsOffOrHasTooFewPoints) {
  Cloud cloud = wall();
  cloud.push_back(point_at({1.0F, 0.5F, 0.5F}));
  EXPECT_EQ(OutlierFilter({.neighbours = 0}).apply(cloud), 0U);
  Cloud few{point_at({0.0F, 0.0F, 1.0F}), point_at({0.0F, 0.0F, 5.0F})};
  EXPECT_EQ(OutlierFilter({}).apply(few), 0U);
  Cloud none;
  EXPECT_EQ(OutlierFilter({}).apply(none), 0U);
}

TEST(OutlierFilter, TellsAllThatIsWrongWithItsSettings) {
  EXPECT_TRUE(OutlierConfig{}.problems().empty());
  EXPECT_TRUE((OutlierConfig{.neighbours = 0}.problems().empty()));
  EXPECT_THAT(
      (OutlierConfig{.neighbours = -1, .max_sigma = 0.0, .kept_within_m = -1.0}.problems()),
      testing::ElementsAre(HasSubstr("outliers.neighbours"), HasSubstr("outliers.max_sigma"),
                           HasSubstr("outliers.kept_within_m")));
}

}  // namespace
}  // namespace tsg
