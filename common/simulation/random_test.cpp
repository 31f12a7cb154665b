#include "common/simulation/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tsg::simulation {
namespace {

TEST(Random, TheSameSeedGivesTheSameNumbersOnEveryMachine) {
  Random random(42);
  // SplitMix64's published sequence for this seed.
  EXPECT_EQ(random.next(), 13679457532755275413ULL);
  EXPECT_EQ(random.next(), 2949826092126892291ULL);
}

TEST(Random, NumbersKeepToTheirRangesAndDistributions) {
  Random random(7);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 20'000;
  for (int i = 0; i < kCount; ++i) {
    const double uniform = random.uniform(-2.0, 3.0);
    ASSERT_GE(uniform, -2.0);
    ASSERT_LT(uniform, 3.0);
    const int integer = random.integer(1, 6);
    ASSERT_GE(integer, 1);
    ASSERT_LE(integer, 6);
    const double normal = random.normal();
    sum += normal;
    squares += normal * normal;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.03);
  EXPECT_NEAR(std::sqrt(squares / kCount), 1.0, 0.03);
}

TEST(Random, NamesHaveSeedsOfTheirOwn) {
  EXPECT_NE(seed_of(1, "chair_1"), seed_of(1, "chair_2"));
  EXPECT_NE(seed_of(1, "chair_1"), seed_of(2, "chair_1"));
  EXPECT_EQ(seed_of(1, "chair_1"), seed_of(1, "chair_1"));
}

}  // namespace
}  // namespace tsg::simulation
