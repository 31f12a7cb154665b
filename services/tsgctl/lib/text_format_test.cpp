#include "services/tsgctl/lib/text_format.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

TEST(TextFormat, BytesChangeUnitBeforeTheyReadAsOneThousand) {
  EXPECT_EQ(format_bytes(0), "0 B");
  EXPECT_EQ(format_bytes(999), "999 B");
  EXPECT_EQ(format_bytes(21'340), "21.3 kB");
  EXPECT_EQ(format_bytes(999'960), "1.0 MB");
  EXPECT_EQ(format_bytes(4'000'000), "4.0 MB");
}

TEST(TextFormat, DurationsShowHoursOnlyWhereThereAreAny) {
  EXPECT_EQ(format_duration(7.2), "0:07");
  EXPECT_EQ(format_duration(754.0), "12:34");
  EXPECT_EQ(format_duration(3723.0), "1:02:03");
  EXPECT_EQ(format_duration(-1.0), "0:00");
}

TEST(TextFormat, TableAlignsColumnsAndLeavesNoTrailingSpaces) {
  EXPECT_EQ(format_table({{"a", "long", "x"}, {"bcd", "y"}}, 1), " a    long  x\n bcd  y\n");
}

TEST(TextFormat, TableAlignsByCharactersNotBytes) {
  EXPECT_EQ(format_table({{"±", "x"}, {"ab", "y"}}), "±   x\nab  y\n");
}

}  // namespace
}  // namespace tsg
