#include "services/map_server/lib/tags/tag_matching.hpp"

#include <gtest/gtest.h>

#include "services/map_server/lib/tags/tag_fixture.hpp"

namespace tsg {
namespace {

const TagConfig kConfig;

Eigen::AlignedBox3f box_at(float x, float size) {
  return {Eigen::Vector3f(x, 0, 0), Eigen::Vector3f(x + size, 0.1F, 0.1F)};
}

TagCells cells_between(float low, float high) {
  return {kConfig.voxel_m, test::surface_of({2.0F, low, 0.0F}, {2.2F, high, 0.3F}),
          Eigen::Vector3f::Zero()};
}

SeenInstance seen_between(const Instance& instance, float low, float high) {
  const TagCells cells = cells_between(low, high);
  return {0, &instance, 57, cells, rough_box(cells)};
}

TagRecord record_between(float low, float high) {
  TagRecord record{.class_name = "bench", .cells = cells_between(low, high)};
  record.box = rough_box(record.cells);
  return record;
}

TEST(AreCentresNear, ComparesTheirDistanceWithTheMeanWidth) {
  EXPECT_TRUE(are_centres_near(box_at(0.0F, 0.4F), box_at(0.2F, 0.6F)));   // 0.3 m < 0.5 m
  EXPECT_FALSE(are_centres_near(box_at(0.0F, 0.4F), box_at(0.5F, 0.6F)));  // 0.6 m > 0.5 m
}

TEST(Fit, IsForOneClassOnly) {
  const Instance bench{"bench", 1.0F, {}};
  const Instance couch{"couch", 1.0F, {}};
  EXPECT_TRUE(fit(seen_between(bench, 0, 1), record_between(0, 1), kConfig));
  EXPECT_FALSE(fit(seen_between(couch, 0, 1), record_between(0, 1), kConfig));
}

TEST(Fit, TakesThePartOfSomethingLargeThatIsFarFromItsMiddle) {
  const Instance bench{"bench", 1.0F, {}};
  EXPECT_TRUE(fit(seen_between(bench, 0.0F, 0.2F), record_between(0, 2), kConfig));
  EXPECT_FALSE(fit(seen_between(bench, 2.1F, 2.3F), record_between(0, 2), kConfig));
}

TEST(Fit, IsBetterForWhatIsFollowedFromMaskToMask) {
  Instance bench{"bench", 1.0F, {}};
  bench.track_id = 5;
  TagRecord record = record_between(0, 1);
  const double unknown = fit(seen_between(bench, 0, 1), record, kConfig).value();
  record.track_id = 5;
  EXPECT_GT(fit(seen_between(bench, 0, 1), record, kConfig).value(), unknown);
}

TEST(Match, GivesEachTagOnceAndTheBestFitsFirst) {
  const Instance bench{"bench", 1.0F, {}};
  const std::vector<TagRecord> records{record_between(0, 1), record_between(0.3F, 1.3F)};
  const std::vector<SeenInstance> seen{seen_between(bench, 0.2F, 1.2F),
                                       seen_between(bench, 0.3F, 1.3F),
                                       seen_between(bench, 5.0F, 6.0F)};
  const auto record_of = match(seen, records, kConfig);
  EXPECT_EQ(record_of[0], 0U) << "its better fit is taken";
  EXPECT_EQ(record_of[1], 1U);
  EXPECT_EQ(record_of[2], std::nullopt);
}

TEST(AreOneObject, UnlessTheyAreSeenSideBySide) {
  TagRecord a = record_between(0, 1);
  TagRecord b = record_between(0.2F, 1);
  a.sightings = {{1, 0}, {2, 0}, {3, 0}};
  b.sightings = {{4, 0}, {5, 0}};
  EXPECT_TRUE(are_one_object(a, b, kConfig));
  b.sightings = {{2, 1}, {3, 1}};
  EXPECT_FALSE(are_one_object(a, b, kConfig));
}

}  // namespace
}  // namespace tsg
