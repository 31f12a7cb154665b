#include "services/tsgctl/dynamic/methods_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(SequenceNames, AreThoseOfTheFolders) {
  EXPECT_THAT(sequence_names({"data/crowd", "/tmp/moved_chair/"}),
              ElementsAre("crowd", "moved_chair"));
}

TEST(SequenceNames, HaveTheFolderAboveWhereTwoAreAlike) {
  EXPECT_THAT(sequence_names({"recorded/chair", "simulated/chair/", "crowd"}),
              ElementsAre("recorded/chair", "simulated/chair", "crowd"));
}

TEST(RunMethods, TellsOfEachRunThatFailsAndGoesOn) {
  MethodsOptions options;
  options.sequences = {"/absent/one", "/absent/two"};
  options.methods = {DynamicMethod::kNone, DynamicMethod::kTsg};
  options.variants = {*find_variant("late3")};
  std::vector<std::string> begun;
  std::vector<std::size_t> done;
  const MethodsReport report = run_methods(
      options, "tsgctl report",
      {.on_progress = [&](const MethodsProgress& now) { begun.push_back(now.run); },
       .on_sequence = [&](const MethodsReport& now) { done.push_back(now.problems().size()); }});
  EXPECT_THAT(done, ElementsAre(3, 6));
  EXPECT_EQ(report.command, "tsgctl report");
  EXPECT_THAT(begun, ElementsAre("one, none", "one, tsg", "one, late3", "two, none", "two, tsg",
                                 "two, late3"));
  ASSERT_EQ(report.sequences.size(), 2U);
  EXPECT_EQ(report.sequences[1].methods.size(), 2U);
  EXPECT_EQ(report.problems().size(), 6U);
  EXPECT_THAT(report.problems()[5], HasSubstr("two, late3: there is no folder /absent/two"));
}

}  // namespace
}  // namespace tsg
