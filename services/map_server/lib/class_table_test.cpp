#include "services/map_server/lib/class_table.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <tuple>

namespace tsg {
namespace {

TEST(ClassTable, NumbersCocoClassesFromOne) {
  ClassTable table;
  EXPECT_EQ(table.id_of("person"), 1);
  EXPECT_EQ(table.id_of("chair"), 57);
  EXPECT_EQ(table.id_of("toothbrush"), 80);
  EXPECT_EQ(table.name_of(57), "chair");
}

TEST(ClassTable, GivesOtherNamesTheNextIdsAndKeepsThem) {
  ClassTable table;
  EXPECT_EQ(table.id_of("robot arm"), 81);
  EXPECT_EQ(table.id_of("forklift"), 82);
  EXPECT_EQ(table.id_of("robot arm"), 81);
  EXPECT_EQ(table.name_of(82), "forklift");
}

TEST(ClassTable, CallsNamesBeyondItsCapacityOther) {
  ClassTable table;
  ClassId last = 0;
  for (int i = 0; i < 300; ++i) last = table.id_of("name " + std::to_string(i));
  EXPECT_EQ(last, kOtherClass);
  EXPECT_EQ(table.name_of(last), "other");
  EXPECT_EQ(table.name_of(kOtherClass - 1), "name 172");  // 1..80 are COCO's, 81 is "name 0"
}

TEST(ClassTable, ColoursOfCocoClassesAreDistinctAndNeverNearlyBlackOrWhite) {
  ClassTable table;
  std::set<std::tuple<int, int, int>> seen;
  for (int id = 1; id <= 80; ++id) {
    const Rgb colour = table.colour_of(static_cast<ClassId>(id));
    EXPECT_TRUE(seen.emplace(colour.r, colour.g, colour.b).second) << table.name_of(ClassId(id));
    const int brightest = std::max({colour.r, colour.g, colour.b});
    const int darkest = std::min({colour.r, colour.g, colour.b});
    EXPECT_GE(brightest, 150);
    EXPECT_GE(brightest - darkest, 80);
  }
}

TEST(ClassTable, ColourDependsOnTheNameOnly) {
  ClassTable one;
  ClassTable other;
  (void)other.id_of("forklift");
  EXPECT_EQ(one.colour_of(one.id_of("robot arm")), other.colour_of(other.id_of("robot arm")));
}

}  // namespace
}  // namespace tsg
