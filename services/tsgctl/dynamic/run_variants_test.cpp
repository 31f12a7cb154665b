#include "services/tsgctl/dynamic/run_variants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace tsg {
namespace {

using ::testing::HasSubstr;

TEST(RunVariants, EachIsFoundByItsNameAndNamesAreUnique) {
  std::set<std::string_view> names;
  for (const RunVariant& variant : run_variants()) {
    EXPECT_TRUE(names.insert(variant.name).second) << variant.name;
    const auto found = find_variant(variant.name);
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, &variant);
    EXPECT_FALSE(variant.text.empty());
    EXPECT_TRUE(variant.masks.faults.problems().empty()) << variant.name;
    EXPECT_TRUE(variant.masks.faults.any() || !variant.masks.use) << variant.name;
  }
}

TEST(RunVariants, TheyAreWhatTheyAreCalled) {
  EXPECT_EQ((*find_variant("late6"))->masks.faults.late_frames, 6);
  EXPECT_EQ((*find_variant("every10"))->masks.faults.every_frames, 10);
  EXPECT_EQ((*find_variant("shrunk"))->masks.faults.shrink_px, 10);
  EXPECT_FALSE((*find_variant("nomasks"))->masks.use);
}

TEST(RunVariants, AnUnknownOneIsToldWithThoseThereAre) {
  const auto found = find_variant("late2");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ExitCode::kUsage);
  EXPECT_THAT(found.error().message, HasSubstr("late2; choose among late1 late3"));
}

}  // namespace
}  // namespace tsg
