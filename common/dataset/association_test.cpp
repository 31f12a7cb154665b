#include "common/dataset/association.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

namespace tsg {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Stamps = std::vector<std::int64_t>;

TEST(Associate, PairsEachStampOnceWithTheClosestFree) {
  // 10 is closest to 11; 8 must then do with 5.
  EXPECT_THAT(associate(Stamps{8, 10}, Stamps{5, 11}, 5),
              ElementsAre(StampPair{0, 0}, StampPair{1, 1}));
  // 12 takes 11, and what is left for 9 is too far.
  EXPECT_THAT(associate(Stamps{9, 12}, Stamps{11}, 5), ElementsAre(StampPair{1, 0}));
}

TEST(Associate, PutsTheSmallestDifferenceFirstEvenAtTheCostOfAPair) {
  // In order of time 0-4, 6-8 would both fit; the closest pair is 4-6.
  EXPECT_THAT(associate(Stamps{0, 6}, Stamps{4}, 4), ElementsAre(StampPair{1, 0}));
}

TEST(Associate, TakesTheMaximumDifferenceAsStillWithin) {
  EXPECT_THAT(associate(Stamps{0}, Stamps{20}, 20), ElementsAre(StampPair{0, 0}));
  EXPECT_THAT(associate(Stamps{0}, Stamps{21}, 20), IsEmpty());
}

TEST(Associate, PrefersTheEarlierStampWhereDifferencesAreEqual) {
  EXPECT_THAT(associate(Stamps{0, 10}, Stamps{5}, 5), ElementsAre(StampPair{0, 0}));
  EXPECT_THAT(associate(Stamps{5}, Stamps{0, 10}, 5), ElementsAre(StampPair{0, 0}));
}

TEST(Associate, FindsNothingInEmptySeries) {
  EXPECT_THAT(associate({}, Stamps{1}, 5), IsEmpty());
  EXPECT_THAT(associate(Stamps{1}, {}, 5), IsEmpty());
}

TEST(Associate, PairsRandomSeriesUniquelyWithinTheLimitAndLeavesNoFreePair) {
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<std::int64_t> stamps(0, 3000);
  std::set<std::int64_t> first;
  std::set<std::int64_t> second;
  while (first.size() < 200) first.insert(stamps(random));
  while (second.size() < 300) second.insert(stamps(random));
  const Stamps a(first.begin(), first.end());
  const Stamps b(second.begin(), second.end());
  for (const StampPair& pair : associate(a, b, 10)) {
    EXPECT_LE(std::abs(a[pair.first] - b[pair.second]), 10);
    EXPECT_EQ(first.erase(a[pair.first]), 1U);
    EXPECT_EQ(second.erase(b[pair.second]), 1U);
  }
  for (const std::int64_t left : first) {
    const auto next = second.lower_bound(left - 10);
    EXPECT_TRUE(next == second.end() || *next > left + 10) << left << " could have had a partner";
  }
}

}  // namespace
}  // namespace tsg
