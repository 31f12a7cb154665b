#include "services/segmentation/scheduling.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(CpuList, NamesSingleCpusAndRanges) {
  EXPECT_THAT(*parse_cpu_list("1"), ElementsAre(1));
  EXPECT_THAT(*parse_cpu_list("6,2-3"), ElementsAre(2, 3, 6));
  EXPECT_THAT(*parse_cpu_list("0-0,0"), ElementsAre(0));
}

TEST(CpuList, IsRefusedWhereItIsNone) {
  for (const char* text : {"", "all", "1,", ",1", "1-", "3-2", "-1", "1 2", "99999", "1.5"}) {
    const auto list = parse_cpu_list(text);
    ASSERT_FALSE(list.has_value()) << text;
    EXPECT_EQ(list.error().code, ExitCode::kConfig);
    EXPECT_THAT(list.error().message, HasSubstr(std::string("'") + text + "'"));
  }
}

}  // namespace
}  // namespace tsg
