#include "services/slam/lib/place_index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "services/slam/lib/synthetic_places.hpp"

namespace tsg {
namespace {

using testing::IsEmpty;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kMinMatches = 20;
constexpr KeyframeId kPlaces = 6;
constexpr KeyframeId kOthers = 250;

/// Six places, and hundreds of others of the same kind of things.
struct World {
  World() {
    for (unsigned seed = 0; seed < kPlaces; ++seed) {
      places.push_back(std::make_shared<const Features>(synthetic::place(seed)));
    }
    std::vector<Features> things;
    for (unsigned seed = 30; seed < 34; ++seed) things.push_back(synthetic::place(seed));
    std::mt19937 generator(1);
    for (std::size_t i = 0; i < kOthers; ++i) others.push_back(synthetic::mixed(things, generator));
  }
  std::vector<std::shared_ptr<const Features>> places;  ///< keyframes 0 ..
  std::vector<std::shared_ptr<const Features>> others;  ///< keyframes kPlaces ..
};

const World& world() {
  static const World kWorld;
  return kWorld;
}

PlaceIndex make_index(std::size_t max_keyframes) {
  PlaceIndex index(max_keyframes);
  KeyframeId id = 0;
  for (const auto& place : world().places) index.add(id++, place);
  for (const auto& other : world().others) index.add(id++, other);
  return index;
}

const PlaceIndex& full_index() {
  static const PlaceIndex kIndex = make_index(1000);
  return kIndex;
}

bool are_equal(const std::vector<PlaceCandidate>& a, const std::vector<PlaceCandidate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.keyframe == y.keyframe && x.matches == y.matches && x.score == y.score;
  });
}

/// Place `seed` from 23 cm and 15 degrees aside.
Features from_aside(unsigned seed) {
  const double side = seed % 2 == 0 ? 1.0 : -1.0;
  return synthetic::place(seed, synthetic::pose_at(0.2 * side, 0.05, 0.1, -15.0 * kDegree * side));
}

TEST(PlaceIndex, FindsAPlaceSeenFromASideAmongHundreds) {
  const PlaceIndex& index = full_index();
  for (unsigned seed = 0; seed < kPlaces; ++seed) {
    const auto found = index.query(from_aside(seed), {}, kMinMatches);
    ASSERT_FALSE(found.empty()) << "place " << seed;
    EXPECT_EQ(found.front().keyframe, seed);
    const double next = found.size() > 1 ? found[1].score : 0.0;
    EXPECT_GT(found.front().score, 1.4 * next);
  }
}

TEST(PlaceIndex, NothingStandsOutForANewPlace) {
  const PlaceIndex& index = full_index();
  const double known = index.query(from_aside(0), {}, 1).front().score;
  for (unsigned seed = 70; seed < 73; ++seed) {
    const auto found = index.query(synthetic::place(seed), {}, 1);
    const double best = found.empty() ? 0.0 : found.front().score;
    EXPECT_LT(best, 0.75 * known) << "place " << seed;
  }
}

TEST(PlaceIndex, FindsNothingWhileItIsEmpty) {
  EXPECT_THAT(PlaceIndex(10).query(*world().places[0], {}, 1), IsEmpty());
}

TEST(PlaceIndex, DoesNotProposeWhatIsExcluded) {
  const PlaceIndex& index = full_index();
  EXPECT_EQ(index.query(*world().places[3], {}, kMinMatches).front().keyframe, 3U);
  for (const PlaceCandidate& candidate : index.query(*world().places[3], {3}, 1)) {
    EXPECT_NE(candidate.keyframe, 3U);
  }
}

TEST(PlaceIndex, ForgetsAKeyframeThatIsRemoved) {
  PlaceIndex index = full_index();
  const std::size_t entries = index.entry_count();
  index.remove(2);
  EXPECT_EQ(index.size(), kPlaces + kOthers - 1);
  EXPECT_LT(index.entry_count(), entries);
  for (const PlaceCandidate& candidate : index.query(*world().places[2], {}, 1)) {
    EXPECT_NE(candidate.keyframe, 2U);
  }
  index.remove(2);
  EXPECT_EQ(index.size(), kPlaces + kOthers - 1);
  index.add(9999, world().places[2]);
  EXPECT_EQ(index.query(*world().places[2], {}, kMinMatches).front().keyframe, 9999U);
}

TEST(PlaceIndex, IsEmptyAgainOnceAllAreRemoved) {
  PlaceIndex index = full_index();
  for (KeyframeId id = 0; id < kPlaces + kOthers; ++id) index.remove(id);
  EXPECT_EQ(index.size(), 0U);
  EXPECT_EQ(index.entry_count(), 0U);
}

TEST(PlaceIndex, StaysWithinItsBoundAndKeepsOldAndNewPlaces) {
  constexpr std::size_t kMax = 40;
  const PlaceIndex index = make_index(kMax);
  EXPECT_LE(index.size(), kMax);
  EXPECT_LE(index.entry_count(), kMax * 1000 * PlaceIndex::kTables);
  const auto newest = index.query(*world().others.back(), {}, kMinMatches);
  ASSERT_FALSE(newest.empty());
  EXPECT_EQ(newest.front().keyframe, kPlaces + kOthers - 1);
}

TEST(PlaceIndex, ThinsOutEvenlyWhereItIsFull) {
  PlaceIndex index(4);
  for (KeyframeId id = 0; id < 5; ++id) index.add(id, world().others[id]);
  EXPECT_EQ(index.size(), 3U);
  for (const KeyframeId kept : {1U, 3U, 4U}) {
    const auto found = index.query(*world().others[kept], {}, kMinMatches);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front().keyframe, kept);
  }
}

TEST(PlaceIndex, AnswersTheSameWhateverWasThereBefore) {
  const PlaceIndex& fresh = full_index();
  PlaceIndex used(1000);
  std::mt19937 generator(5);
  for (KeyframeId id = 5000; id < 5040; ++id) {
    used.add(id, synthetic::disguised(*world().places[id % kPlaces], 0.1, generator));
  }
  for (KeyframeId id = 5000; id < 5040; ++id) used.remove(id);
  KeyframeId id = 0;
  for (const auto& place : world().places) used.add(id++, place);
  for (const auto& other : world().others) used.add(id++, other);
  const Features asked = synthetic::place(1, synthetic::pose_at(0.1, 0.0, 0.1));
  EXPECT_TRUE(are_equal(fresh.query(asked, {}, 1), used.query(asked, {}, 1)));
  EXPECT_TRUE(are_equal(fresh.query(asked, {}, 1), fresh.query(asked, {}, 1)));
}

}  // namespace
}  // namespace tsg
