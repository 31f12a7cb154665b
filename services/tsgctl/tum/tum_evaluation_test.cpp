#include "services/tsgctl/tum/tum_evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

std::vector<std::string> sequences(std::vector<int> tables, std::vector<std::string> names = {}) {
  TumOptions options;
  options.tables = std::move(tables);
  options.names = std::move(names);
  return tum_sequences(options).value();
}

TEST(TumSequences, AreThoseOfTheTables) {
  EXPECT_THAT(sequences({2, 3, 4, 5}), SizeIs(6));
  EXPECT_THAT(sequences({4}), ElementsAre("fr3/walking_static", "fr3/walking_xyz"));
  EXPECT_THAT(sequences({5}),
              ElementsAre("fr3/sitting_static", "fr3/walking_static", "fr3/walking_xyz"));
}

TEST(TumSequences, AreTheNamedOnesOnceEach) {
  EXPECT_THAT(sequences({2, 3, 4, 5}, {"fr1/xyz", "fr1/desk", "rgbd_dataset_freiburg1_xyz"}),
              ElementsAre("fr1/xyz", "fr1/desk"));
}

TEST(TumSequences, MustBeOfTheBenchmark) {
  TumOptions options;
  options.names = {"kitti/00"};
  const auto names = tum_sequences(options);
  ASSERT_FALSE(names);
  EXPECT_EQ(names.error().code, ExitCode::kUsage);
}

}  // namespace
}  // namespace tsg
