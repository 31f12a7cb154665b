#include "services/segmentation/lib/instance_tracker.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace tsg {
namespace {

constexpr std::int64_t kBetweenMasksNs = 100'000'000;  // 10 Hz

/// A box that stands for a thing; later ones cover earlier ones.
struct Thing {
  cv::Rect box;
  const char* class_name = "person";
};

/// The mask of things at 10 Hz; what is nearly covered is not found.
InstanceSegmentation things_seen(const std::vector<Thing>& things, int number) {
  InstanceSegmentation mask;
  mask.stamp_ns = number * kBetweenMasksNs;
  cv::Mat drawn(480, 640, CV_8UC1, cv::Scalar(0));
  const cv::Rect image(cv::Point(0, 0), drawn.size());
  for (std::size_t i = 0; i < things.size(); ++i) {
    drawn(things[i].box & image).setTo(static_cast<double>(i + 1));
  }
  mask.labels = cv::Mat::zeros(drawn.size(), CV_8UC1);
  for (std::size_t i = 0; i < things.size(); ++i) {
    const cv::Mat shown = drawn == static_cast<double>(i + 1);
    if (cv::countNonZero(shown) < things[i].box.area() / 6) continue;
    mask.instances.push_back(
        {.class_name = things[i].class_name, .score = 0.9F, .box = cv::boundingRect(shown)});
    mask.labels.setTo(static_cast<double>(mask.instances.size()), shown);
  }
  return mask;
}

std::vector<std::uint32_t> follow(InstanceTracker& tracker, InstanceSegmentation mask) {
  tracker.follow(mask);
  std::vector<std::uint32_t> ids;
  for (const Instance& instance : mask.instances) ids.push_back(instance.track_id);
  return ids;
}

Thing person_at(int x) { return {{x, 100, 100, 300}}; }

TEST(InstanceTracker, KeepsTheIdOfWhatMovesAndGivesEachItsOwn) {
  InstanceTracker tracker;
  const auto first = follow(tracker, things_seen({person_at(50), person_at(400)}, 0));
  ASSERT_EQ(first.size(), 2U);
  EXPECT_NE(first[0], 0U);
  EXPECT_NE(first[0], first[1]);
  for (int i = 1; i < 10; ++i) {
    // Found in another order each time.
    const bool swapped = i % 2 == 0;
    const Thing a = person_at(50 + 15 * i);
    const Thing b = person_at(400 - 3 * i);
    const auto ids = follow(tracker, things_seen({swapped ? b : a, swapped ? a : b}, i));
    EXPECT_EQ(ids[swapped ? 1 : 0], first[0]) << i;
    EXPECT_EQ(ids[swapped ? 0 : 1], first[1]) << i;
  }
}

struct Crossing {
  int hidden = 0;       ///< masks that do not show the one behind
  bool is_kept = true;  ///< the one behind had the same id after as before
};

/// Somebody walks by behind somebody else, each `step` pixels a mask; the network's boxes and masks
/// are wrong by some pixels.
Crossing cross(int step, int offset, std::mt19937& random) {
  SCOPED_TRACE("step " + std::to_string(step) + ", offset " + std::to_string(offset));
  std::uniform_int_distribution<int> error(-4, 4);
  InstanceTracker tracker;
  std::vector<std::uint32_t> first;
  Crossing crossing;
  for (int i = 0; i * step < 480; ++i) {
    const Thing behind{{500 + offset - step * i + error(random), 100, 100 + error(random), 300}};
    const Thing in_front{{step * i + error(random), 80, 170 + error(random), 340}};
    const auto ids = follow(tracker, things_seen({behind, in_front}, i));
    if (i == 0) first = ids;
    EXPECT_EQ(ids.back(), first.at(1)) << "of the one in front, mask " << i;
    crossing.hidden += ids.size() == 1 ? 1 : 0;
    if (ids.size() == 2) crossing.is_kept = ids.front() == first.front();
  }
  return crossing;
}

TEST(InstanceTracker, TellsPeopleWhoCrossApartAfterOneWasHidden) {
  std::mt19937 random(1);
  int crossings = 0;
  int kept = 0;
  for (const int step : {6, 13, 20, 30}) {
    for (int offset = 0; offset < step; offset += 4) {
      const Crossing crossing = cross(step, offset, random);
      EXPECT_GT(crossing.hidden, 0) << "nobody was hidden";
      ++crossings;
      kept += crossing.is_kept ? 1 : 0;
    }
  }
  EXPECT_GE(kept, crossings * 9 / 10) << "of " << crossings;
}

TEST(InstanceTracker, FindsAThingAgainThatTheNetworkMissedForSomeFrames) {
  InstanceTracker tracker;
  const auto first = follow(tracker, things_seen({person_at(50)}, 0));
  EXPECT_EQ(follow(tracker, things_seen({person_at(70)}, 1)), first);
  EXPECT_EQ(follow(tracker, things_seen({person_at(90)}, 2)), first);
  for (int i = 3; i < 10; ++i) EXPECT_TRUE(follow(tracker, things_seen({}, i)).empty());
  EXPECT_EQ(follow(tracker, things_seen({person_at(50 + 10 * 20)}, 10)), first);
}

TEST(InstanceTracker, GivesANewIdToWhoComesBackLater) {
  InstanceTracker tracker;
  const auto first = follow(tracker, things_seen({person_at(50)}, 0));
  const int late = static_cast<int>(InstanceTracker::kMemoryNs / kBetweenMasksNs) + 1;
  const auto later = follow(tracker, things_seen({person_at(50)}, late));
  ASSERT_EQ(later.size(), 1U);
  EXPECT_NE(later, first);
}

TEST(InstanceTracker, GivesWhoEntersElsewhereANewIdAndWhoStaysHisOwn) {
  InstanceTracker tracker;
  const auto first = follow(tracker, things_seen({person_at(50)}, 0));
  const auto both = follow(tracker, things_seen({person_at(540), person_at(50)}, 1));
  EXPECT_EQ(both.at(1), first.at(0));
  EXPECT_NE(both.at(0), first.at(0));
}

TEST(InstanceTracker, NeverTakesAThingForOneOfAnotherClass) {
  InstanceTracker tracker;
  const auto person = follow(tracker, things_seen({{{50, 100, 100, 300}, "person"}}, 0));
  const auto chair = follow(tracker, things_seen({{{50, 100, 100, 300}, "chair"}}, 1));
  EXPECT_NE(person, chair);
  EXPECT_EQ(follow(tracker, things_seen({{{50, 100, 100, 300}, "person"}}, 2)), person);
}

TEST(InstanceTracker, BeginsAnewWithAnOlderMaskOrOneOfAnotherSize) {
  InstanceTracker tracker;
  std::set<std::uint32_t> ids;
  ids.insert(follow(tracker, things_seen({person_at(50)}, 5)).at(0));
  ids.insert(follow(tracker, things_seen({person_at(50)}, 4)).at(0));
  InstanceSegmentation wider = things_seen({person_at(50)}, 5);
  cv::copyMakeBorder(wider.labels, wider.labels, 0, 0, 0, 8, cv::BORDER_CONSTANT);
  ids.insert(follow(tracker, wider).at(0));
  EXPECT_EQ(ids.size(), 3U);
}

TEST(InstanceTracker, FollowsByBoxesWhatHasNoPixels) {
  InstanceTracker tracker;
  InstanceSegmentation mask = things_seen({person_at(50)}, 0);
  mask.labels.setTo(0);
  const auto first = follow(tracker, mask);
  mask.stamp_ns += kBetweenMasksNs;
  EXPECT_EQ(follow(tracker, mask), first);
}

}  // namespace
}  // namespace tsg
