#include "services/map_server/lib/tags/instance_cleaning.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "services/map_server/lib/tags/tag_fixture.hpp"

namespace tsg {
namespace {

using test::surface_of;

void append(Cloud& cloud, const Cloud& more) {
  cloud.insert(cloud.end(), more.begin(), more.end());
}

// Camera axes: z is depth.

TEST(CleanInstance, DropsTheWallBehindThatTheMaskReachesOver) {
  const Cloud monitor = surface_of({-0.3F, -0.2F, 1.5F}, {0.3F, 0.2F, 1.55F});
  Cloud seen = monitor;
  append(seen, surface_of({0.3F, -0.2F, 2.2F}, {0.8F, 0.2F, 2.21F}));  // a third as large
  EXPECT_EQ(clean_instance(seen).size(), monitor.size());
}

TEST(CleanInstance, KeepsBothPartsOfATableBehindAChair) {
  Cloud table = surface_of({-1.0F, 0.3F, 2.0F}, {-0.4F, 0.35F, 2.6F});
  append(table, surface_of({0.4F, 0.3F, 2.0F}, {0.8F, 0.35F, 2.6F}));
  EXPECT_EQ(clean_instance(table).size(), table.size());
}

TEST(CleanInstance, DropsSpecksBesideIt) {
  const Cloud chair = surface_of({-0.3F, -0.2F, 2.0F}, {0.3F, 0.2F, 2.4F});
  Cloud seen = chair;
  append(seen, surface_of({0.8F, 0.0F, 2.2F}, {0.85F, 0.05F, 2.22F}));
  EXPECT_EQ(clean_instance(seen).size(), chair.size());
}

TEST(CleanInstance, JoinsFarPointsOverWiderGaps) {
  const auto rows_apart = [](float depth_m) {
    Cloud rows;
    for (int i = 0; i < 8; ++i) {  // of a table top seen at a grazing angle
      const float z = depth_m + 0.1F * static_cast<float>(i);
      for (int k = 0; k < 50; ++k) {
        rows.push_back({{0.01F * static_cast<float>(k), 0.5F, z}, {}, 61, 1});
      }
    }
    rows.push_back({{0.0F, 0.5F, depth_m}, {}, 61, 10});  // one row weighs more than the others
    return rows;
  };
  EXPECT_EQ(clean_instance(rows_apart(4.0F)).size(), 401U);
  EXPECT_LT(clean_instance(rows_apart(0.5F)).size(), 300U);
}

TEST(CleanInstance, LeavesNothingOfNothing) { EXPECT_TRUE(clean_instance({}).empty()); }

}  // namespace
}  // namespace tsg
