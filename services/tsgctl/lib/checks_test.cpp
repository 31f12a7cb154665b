#include "services/tsgctl/lib/checks.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

std::vector<CheckResult> one_of_each() {
  return {passed("RouDi", "answers"), warned("plots", "no gnuplot", "apt-get install gnuplot-nox"),
          failed("shared memory", "64 MB", "make it larger")};
}

TEST(Checks, TextHasTheFixBelowWhatNeedsOne) {
  EXPECT_EQ(checks_text(one_of_each()),
            "ok    RouDi          answers\n"
            "warn  plots          no gnuplot\n"
            "                     -> apt-get install gnuplot-nox\n"
            "FAIL  shared memory  64 MB\n"
            "                     -> make it larger\n");
}

TEST(Checks, OnlyFailuresCount) { EXPECT_EQ(failures_in(one_of_each()), 1); }

TEST(Checks, JsonHoldsEveryCheck) {
  const nlohmann::json json = checks_json(one_of_each());
  EXPECT_EQ(json["failures"], 1);
  ASSERT_EQ(json["checks"].size(), 3U);
  EXPECT_EQ(json["checks"][2]["level"], "FAIL");
  EXPECT_EQ(json["checks"][1]["fix"], "apt-get install gnuplot-nox");
}

}  // namespace
}  // namespace tsg
