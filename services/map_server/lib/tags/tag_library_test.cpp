#include "services/map_server/lib/tags/tag_library.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "services/map_server/lib/tags/tag_fixture.hpp"

namespace tsg {
namespace {

using test::Shown;
using test::surface_of;
using testing::IsEmpty;
using testing::SizeIs;

Place nothing_known(const Eigen::Vector3f& /*position*/) { return Place::kUnknown; }
Place all_occupied(const Eigen::Vector3f& /*position*/) { return Place::kOccupied; }
Place all_free(const Eigen::Vector3f& /*position*/) { return Place::kFree; }

/// A chair, 0.5 m wide and deep and 0.9 m high, with its middle at (x, y) on the floor.
Cloud chair_at(float x, float y) {
  return surface_of({x - 0.25F, y - 0.25F, 0.0F}, {x + 0.25F, y + 0.25F, 0.9F});
}

/// Those of its points that fulfil a condition: a view of a part.
template <typename Condition>
Cloud part_of(Cloud cloud, const Condition& is_seen) {
  std::erase_if(cloud, [&](const CloudPoint& point) { return !is_seen(point.position); });
  return cloud;
}

class TagLibraryTest : public testing::Test {
 protected:
  /// Shows things to the library in as many keyframes in a row.
  void show(const std::vector<Shown>& things, int keyframes = 2, PlaceOf place_of = nothing_known) {
    for (int i = 0; i < keyframes; ++i) {
      library_.add(test::view_of(next_keyframe_++, things), test::camera_pose(), place_of);
    }
  }

  std::vector<Tag> present() const {
    std::vector<Tag> found;
    std::copy_if(library_.tags().begin(), library_.tags().end(), std::back_inserter(found),
                 [](const Tag& tag) { return is_present(tag); });
    return found;
  }

  TagLibrary library_{TagConfig{}};
  std::uint64_t next_keyframe_ = 1;
};

// The branches of the paper's Algorithm 1.

TEST_F(TagLibraryTest, InsertsTheFirstTagOfAClass) {
  show({{"chair", chair_at(3.0F, 0.0F)}});
  ASSERT_THAT(present(), SizeIs(1));
  const Tag& chair = library_.tags()[0];
  EXPECT_EQ(chair.id, 1U);
  EXPECT_EQ(chair.class_name, "chair");
  EXPECT_EQ(chair.observations, 2);
  EXPECT_EQ(chair.first_seen_ns, 1'000'000'000);
  EXPECT_EQ(chair.last_seen_ns, 2'000'000'000);
  EXPECT_EQ(chair.state, TagState::kStatic);
  EXPECT_NEAR(chair.confidence, 1.0 - 0.55 * 0.55, 1e-5);
  EXPECT_LT((chair.centre - Eigen::Vector3f(3.0F, 0.0F, 0.45F)).norm(), 0.02F);
  EXPECT_LT((chair.box.sizes() - Eigen::Vector3f(0.5F, 0.5F, 0.9F)).norm(), 0.03F);
  EXPECT_FALSE(chair.cloud.empty());
}

TEST_F(TagLibraryTest, FusesWhatIsNearerThanItIsWide) {
  show({{"chair", chair_at(3.0F, 0.0F)}});
  show({{"chair", chair_at(3.0F, 0.1F)}});
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_EQ(library_.tags()[0].observations, 4);
  EXPECT_NEAR(library_.tags()[0].box.sizes().y(), 0.6F, 0.03F);
}

TEST_F(TagLibraryTest, InsertsAnotherTagWhereThoseOfTheClassAreFar) {
  show({{"chair", chair_at(3.0F, 0.0F)}});
  show({{"chair", chair_at(3.0F, 1.0F)}});
  ASSERT_THAT(present(), SizeIs(2));
  EXPECT_EQ(library_.tags()[1].id, 2U);
}

TEST_F(TagLibraryTest, InsertsATagOfAClassThatIsNotThereYet) {
  show({{"chair", chair_at(3.0F, 0.0F)}});
  show({{"tv", surface_of({3.0F, -0.2F, 0.9F}, {3.1F, 0.2F, 1.2F})}});
  ASSERT_THAT(present(), SizeIs(2));
  EXPECT_EQ(library_.tags()[1].class_name, "tv");
}

// One object stays one.

TEST_F(TagLibraryTest, MakesOneOfACabinetSeenFromTheFrontAndThenFromTheBack) {
  const Cloud cabinet = surface_of({2.5F, -0.4F, 0.0F}, {2.9F, 0.4F, 1.0F});
  show({{"cabinet", part_of(cabinet, [](const auto& p) { return p.x() < 2.52F; })}});
  show({{"cabinet", part_of(cabinet, [](const auto& p) { return p.x() > 2.88F; })}});
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_NEAR(library_.tags()[0].box.sizes().x(), 0.4F, 0.03F);
}

TEST_F(TagLibraryTest, JoinsTheEndsOfATableOnceItsMiddleIsSeen) {
  const Cloud table = surface_of({2.0F, -1.2F, 0.7F}, {2.8F, 1.2F, 0.75F});
  show({{"dining table", part_of(table, [](const auto& p) { return p.y() < -0.5F; })}});
  show({{"dining table", part_of(table, [](const auto& p) { return p.y() > 0.5F; })}});
  ASSERT_THAT(present(), SizeIs(2));
  show({{"dining table", part_of(table, [](const auto& p) { return std::abs(p.y()) < 0.9F; })}}, 3);
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_EQ(library_.tags()[0].id, 1U);
  EXPECT_EQ(library_.tags()[0].observations, 7);
  EXPECT_NEAR(library_.tags()[0].box.sizes().y(), 2.4F, 0.05F);
}

TEST_F(TagLibraryTest, JoinsTheTopAndTheLegsOfAChairThatWereNeverSeenTogether) {
  const Cloud chair = chair_at(3.0F, 0.0F);
  show({{"chair", part_of(chair, [](const auto& p) { return p.z() > 0.4F; })}}, 3);
  show({{"chair", part_of(chair, [](const auto& p) { return p.z() < 0.55F; })}}, 3);
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_NEAR(library_.tags()[0].box.sizes().z(), 0.9F, 0.03F);
}

TEST_F(TagLibraryTest, DoesNotShrinkWhatIsSeenInPart) {
  const Cloud chair = chair_at(3.0F, 0.0F);
  show({{"chair", chair}}, 3);
  const Eigen::Vector3f size = library_.tags()[0].box.sizes();
  show({{"chair", part_of(chair, [](const auto& p) { return p.y() < -0.1F; })}}, 20);
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_LT((library_.tags()[0].box.sizes() - size).norm(), 0.02F);
}

// Two objects stay two.

TEST_F(TagLibraryTest, KeepsTwoChairsSideBySideApart) {
  show({{"chair", chair_at(3.0F, 0.0F)}, {"chair", chair_at(3.0F, 0.55F)}}, 4);
  ASSERT_THAT(present(), SizeIs(2));
  EXPECT_EQ(library_.tags()[0].observations, 4);
  EXPECT_EQ(library_.tags()[1].observations, 4);
}

TEST_F(TagLibraryTest, KeepsAChairApartFromTheHalfOfItsNeighbourThatTheImageShows) {
  show({{"chair", chair_at(3.0F, 0.0F)}});
  const Cloud half = part_of(chair_at(3.0F, 0.55F), [](const auto& p) { return p.y() < 0.5F; });
  show({{"chair", half}});  // its centre is nearer than the mean width of both
  EXPECT_THAT(present(), SizeIs(2));
}

TEST_F(TagLibraryTest, TellsBooksInARowApart) {
  std::vector<Shown> row;
  for (int i = 0; i < 4; ++i) {
    const float y = 0.05F * static_cast<float>(i);
    row.push_back({"book", surface_of({2.0F, y, 1.0F}, {2.2F, y + 0.05F, 1.25F})});
  }
  show(row, 3);
  std::reverse(row.begin(), row.end());
  show(row, 3);
  ASSERT_THAT(present(), SizeIs(4));
  for (const Tag& book : library_.tags()) EXPECT_NEAR(book.box.sizes().y(), 0.05F, 0.021F);
}

// What is not sure is not told.

TEST_F(TagLibraryTest, KeepsWhatOneKeyframeAloneShowsApart) {
  show({{"chair", chair_at(3.0F, 0.0F)}}, 1);
  EXPECT_THAT(library_.tags(), IsEmpty());
  ASSERT_THAT(library_.tentative(), SizeIs(1));
  EXPECT_EQ(library_.tentative()[0].class_name, "chair");
}

TEST_F(TagLibraryTest, NeedsMoreSightingsOfLowScore) {
  Shown faint{"chair", chair_at(3.0F, 0.0F)};
  faint.score = 0.4F;
  show({faint}, 4);
  EXPECT_THAT(library_.tags(), IsEmpty());
  show({faint}, 1);
  EXPECT_THAT(library_.tags(), SizeIs(1));
}

TEST_F(TagLibraryTest, HasOneNameForOneThing) {
  show({{"couch", chair_at(3.0F, 0.0F)}}, 3);
  show({{"chair", chair_at(3.0F, 0.0F)}}, 4);
  ASSERT_THAT(library_.tags(), SizeIs(1));
  EXPECT_EQ(library_.tags()[0].class_name, "chair");
  EXPECT_THAT(library_.tentative(), SizeIs(1));
}

TEST_F(TagLibraryTest, TakesAGlimpseForNothing) {
  const Cloud chair = chair_at(3.0F, 0.0F);
  show({{"chair", Cloud(chair.begin(), chair.begin() + 90)}}, 3);
  EXPECT_THAT(library_.tags(), IsEmpty());
  EXPECT_THAT(library_.tentative(), IsEmpty());
}

TEST_F(TagLibraryTest, ForgetsTheOldestOfManyMistakes) {
  for (int i = 0; i < 600; ++i) {
    const float y = -2.5F + 0.2F * static_cast<float>(i % 25);
    const float z = 0.2F * static_cast<float>(i / 25);
    show({{"cup", surface_of({2.0F, y, z}, {2.1F, y + 0.1F, z + 0.1F})}}, 1);
  }
  EXPECT_THAT(library_.tentative(), SizeIs(500));
  EXPECT_EQ(library_.tentative().back().id, 600U);
}

// Objects that move or go.

TEST_F(TagLibraryTest, TakesAChairAwayWhileItMovesAndPutsItWhereItStopsUnderItsId) {
  show({{"chair", chair_at(3.0F, 0.0F), 7}, {"chair", chair_at(3.0F, 1.5F), 8}});
  show({{"chair", {}, 7, MotionVerdict::kMoving}, {"chair", chair_at(3.0F, 1.5F), 8}}, 1);
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_EQ(present()[0].id, 2U);
  EXPECT_EQ(library_.tags()[0].state, TagState::kGone);
  show({{"chair", chair_at(3.0F, -1.0F), 7}}, 1);
  ASSERT_THAT(present(), SizeIs(2));
  const Tag& moved = library_.tags()[0];
  EXPECT_EQ(moved.id, 1U);
  EXPECT_EQ(moved.state, TagState::kMoved);
  EXPECT_NEAR(moved.centre.y(), -1.0F, 0.02F);
  EXPECT_NEAR(moved.box.sizes().y(), 0.5F, 0.03F) << "nothing is left of the old place";
}

TEST_F(TagLibraryTest, BelievesThatAChairStandsWhereItStoodWhenItIsSeenThereAgain) {
  show({{"chair", chair_at(3.0F, 0.0F), 7}});
  show({{"chair", {}, 7, MotionVerdict::kMoving}}, 1);
  show({{"chair", chair_at(3.0F, 0.0F), 9}}, 1);
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_EQ(library_.tags()[0].id, 1U);
  EXPECT_EQ(library_.tags()[0].state, TagState::kStatic);
}

TEST_F(TagLibraryTest, ForgetsWhatIsGoneOnceItsPlaceIsFree) {
  show({{"chair", chair_at(3.0F, 0.0F)}});
  show({}, 5, all_occupied);
  EXPECT_THAT(present(), SizeIs(1)) << "hidden, or missed by the segmentation";
  show({}, 2, all_free);
  EXPECT_THAT(present(), SizeIs(1)) << "two looks are not enough";
  show({}, 1, all_free);
  EXPECT_THAT(present(), IsEmpty());
  ASSERT_THAT(library_.tags(), SizeIs(1));
  EXPECT_EQ(library_.tags()[0].state, TagState::kGone);
}

TEST_F(TagLibraryTest, DoesNotJudgePlacesOutOfView) {
  show({{"chair", chair_at(-3.0F, 0.0F)}});  // behind the camera
  show({}, 5, all_free);
  EXPECT_THAT(present(), SizeIs(1));
}

TEST_F(TagLibraryTest, LooksAtAllPlacesInTurnHoweverFewAtATime) {
  TagConfig config;
  config.checks_per_keyframe = 1;
  library_ = TagLibrary(config);
  show({{"chair", chair_at(3.0F, 0.0F)}, {"chair", chair_at(3.0F, 1.0F)}});
  show({}, 4, all_free);
  EXPECT_THAT(present(), SizeIs(2));
  show({}, 2, all_free);
  EXPECT_THAT(present(), IsEmpty());
}

TEST_F(TagLibraryTest, KnowsAChairAgainThatWasCarriedElsewhereWhileNobodyLooked) {
  show({{"chair", chair_at(3.0F, 0.0F)}});
  show({{"chair", chair_at(3.0F, 1.5F)}}, 4, all_free);
  ASSERT_THAT(library_.tags(), SizeIs(1));
  EXPECT_EQ(library_.tags()[0].id, 1U);
  EXPECT_EQ(library_.tags()[0].state, TagState::kMoved);
  EXPECT_NEAR(library_.tags()[0].centre.y(), 1.5F, 0.02F);
}

TEST_F(TagLibraryTest, TakesAChairInASpaceNeverSeenBeforeForAnotherOne) {
  show({{"chair", chair_at(3.0F, 0.0F)}});
  const auto only_the_old_place = [](const Eigen::Vector3f& position) {
    return position.y() < 0.5F ? Place::kFree : Place::kUnknown;
  };
  show({{"chair", chair_at(3.0F, 1.5F)}}, 4, only_the_old_place);
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_EQ(present()[0].id, 2U);
  EXPECT_EQ(present()[0].state, TagState::kStatic);
}

TEST_F(TagLibraryTest, CutsOffWhatIsFreeOfATag) {
  const Cloud smeared = surface_of({2.75F, -0.25F, 0.0F}, {3.25F, 1.05F, 0.9F});
  show({{"chair", smeared}});
  const auto beyond = [](const Eigen::Vector3f& position) {
    return position.y() > 0.25F ? Place::kFree : Place::kOccupied;
  };
  show({}, 1, beyond);
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_NEAR(library_.tags()[0].box.sizes().y(), 0.5F, 0.03F);
}

// Corrections.

TEST_F(TagLibraryTest, KeepsIdsWhenItIsBuiltAgainAtOtherPoses) {
  const Shown left{"chair", chair_at(3.0F, 1.0F)};
  const Shown right{"chair", chair_at(3.0F, -1.0F)};
  show({right});
  show({left, right});
  TagLibrary again{TagConfig{}};
  for (std::uint64_t id = 3; id <= 4; ++id) {  // the first two keyframes are lost: left comes first
    again.add(test::view_of(id, {left, right}),
              SE3::exp((Vector6d() << 0.5, 0, 0, 0, 0, 0).finished()) * test::camera_pose(),
              nothing_known);
  }
  again.adopt_ids(library_);
  ASSERT_THAT(again.tags(), SizeIs(2));
  EXPECT_EQ(again.tags()[0].id, 1U);
  EXPECT_NEAR(again.tags()[0].centre.y(), -1.0F, 0.02F);
  EXPECT_NEAR(again.tags()[0].centre.x(), 3.5F, 0.02F);
  EXPECT_EQ(again.tags()[1].id, 2U);
}

TEST_F(TagLibraryTest, NeverGivesAnIdAgain) {
  show({{"chair", chair_at(3.0F, 0.0F)}, {"chair", chair_at(3.0F, 1.0F)}});
  TagLibrary again{TagConfig{}};
  for (std::uint64_t id = 10; id <= 11; ++id) {
    again.add(test::view_of(id, {{"chair", chair_at(3.0F, 0.0F)}}), test::camera_pose(),
              nothing_known);
  }
  again.adopt_ids(library_);
  ASSERT_THAT(again.tags(), SizeIs(1));
  EXPECT_EQ(again.tags()[0].id, 3U);
}

TEST_F(TagLibraryTest, BoundsTheCloudOfATag) {
  TagConfig config;
  config.max_voxels = 1000;
  library_ = TagLibrary(config);
  show({{"dining table", surface_of({2.0F, -1.0F, 0.7F}, {3.0F, 1.0F, 0.75F})}});
  ASSERT_THAT(present(), SizeIs(1));
  EXPECT_LE(library_.tags()[0].cloud.size(), 1000U);
  EXPECT_NEAR(library_.tags()[0].box.sizes().y(), 2.0F, 0.1F);
}

}  // namespace
}  // namespace tsg
