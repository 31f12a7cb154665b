#include "common/rgbd/mask_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <opencv2/core.hpp>

#include "common/rgbd/frame_delay.hpp"

namespace tsg {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const cv::Rect kChair{2, 30, 20, 20};
const cv::Rect kPerson{22, 10, 20, 40};  // touches the chair
const cv::Rect kDog{60, 40, 10, 8};      // stands apart

InstanceSegmentation three_things() {
  InstanceSegmentation mask;
  mask.frame_seq = 7;
  mask.labels = cv::Mat(60, 80, CV_8UC1, cv::Scalar(0));
  for (const auto& [name, box] :
       {std::pair{"chair", kChair}, std::pair{"person", kPerson}, std::pair{"dog", kDog}}) {
    mask.instances.push_back({name, 0.9F, box, MotionVerdict::kUnknown});
    mask.labels(box).setTo(static_cast<double>(mask.instances.size()));
  }
  return mask;
}

std::vector<std::string> classes(const InstanceSegmentation& mask) {
  std::vector<std::string> names;
  for (const Instance& instance : mask.instances) names.push_back(instance.class_name);
  return names;
}

int area(const InstanceSegmentation& mask, int label) {
  return cv::countNonZero(mask.labels == label);
}

InstanceSegmentation altered(const MaskFaults& faults, const InstanceSegmentation& mask) {
  return MaskFaultInjector(faults).apply(mask).value();
}

TEST(MaskFaults, AreOffByDefaultAndLeaveTheMaskWhereItIs) {
  const InstanceSegmentation mask = three_things();
  MaskFaultInjector injector(MaskFaults{});
  const auto seen = injector.apply(mask);
  ASSERT_TRUE(seen.has_value());
  EXPECT_EQ(seen->labels.data, mask.labels.data) << "not a pixel is copied";
  EXPECT_EQ(seen->frame_seq, 7U);
  EXPECT_TRUE(injector.is_segmented(1));
  EXPECT_FALSE(MaskFaults{}.any());
  EXPECT_EQ(to_text(MaskFaults{}), "");
}

TEST(MaskFaults, TellWhichAreOn) {
  EXPECT_EQ(to_text({.late_frames = 6, .merge_two = true, .shrink_px = 10}),
            "late_frames=6, merge_two=true, shrink_px=10");
  EXPECT_TRUE(MaskFaults{.every_frames = 10}.any());
}

TEST(MaskFaults, NameEachValueThatIsOutOfRange) {
  const MaskFaults wrong{.late_frames = -1,
                         .every_frames = 0,
                         .drop_every = -1,
                         .drop_instance_every = -2,
                         .shrink_px = 101,
                         .swap_class_every = 301};
  EXPECT_THAT(wrong.problems(),
              ElementsAre(HasSubstr("late_frames must be 0 to 300"),
                          HasSubstr("every_frames must be 1 to 300"), HasSubstr("drop_every"),
                          HasSubstr("drop_instance_every"), HasSubstr("shrink_px must be 0 to 100"),
                          HasSubstr("swap_class_every")));
  EXPECT_THAT(MaskFaults{}.problems(), IsEmpty());
}

TEST(MaskFaults, SegmentEveryTenthFrameOnly) {
  const MaskFaultInjector injector({.every_frames = 10});
  EXPECT_TRUE(injector.is_segmented(0));
  EXPECT_FALSE(injector.is_segmented(9));
  EXPECT_TRUE(injector.is_segmented(20));
}

TEST(MaskFaults, EveryThirdMaskIsMissing) {
  MaskFaultInjector injector({.drop_every = 3});
  std::array<bool, 6> present{};
  for (bool& is_there : present) is_there = injector.apply(three_things()).has_value();
  EXPECT_THAT(present, ElementsAre(true, true, false, true, true, false));
}

TEST(MaskFaults, EverySecondMaskLacksOneInstanceEachInTurn) {
  MaskFaultInjector injector({.drop_instance_every = 2});
  std::array<std::vector<std::string>, 6> seen;
  for (auto& mask : seen) mask = classes(injector.apply(three_things()).value());
  EXPECT_THAT(seen[0], ElementsAre("chair", "person", "dog"));
  EXPECT_THAT(seen[1], ElementsAre("person", "dog"));
  EXPECT_THAT(seen[2], ElementsAre("chair", "person", "dog"));
  EXPECT_THAT(seen[3], ElementsAre("chair", "dog"));
  EXPECT_THAT(seen[5], ElementsAre("chair", "person"));
}

TEST(MaskFaults, PixelsOfADroppedInstanceAreNobodysAndTheOthersKeepTheirs) {
  const InstanceSegmentation whole = three_things();
  const InstanceSegmentation mask = altered({.drop_instance_every = 1}, whole);
  EXPECT_EQ(area(mask, 1), kPerson.area());
  EXPECT_EQ(area(mask, 2), kDog.area());
  EXPECT_EQ(cv::countNonZero(mask.labels), kPerson.area() + kDog.area());
  EXPECT_EQ(area(whole, 1), kChair.area()) << "what the injector was given stays as it was";
}

TEST(MaskFaults, TheTwoThatTouchBecomeOneOfTheBiggersClass) {
  const InstanceSegmentation mask = altered({.merge_two = true}, three_things());
  EXPECT_THAT(classes(mask), ElementsAre("person", "dog"));
  EXPECT_EQ(area(mask, 1), kChair.area() + kPerson.area());
  EXPECT_EQ(area(mask, 2), kDog.area());
  EXPECT_EQ(mask.instances[0].box, cv::Rect2f(kChair | kPerson));
}

TEST(MaskFaults, WhereNoneTouchTheNearestTwoBecomeOne) {
  InstanceSegmentation mask = three_things();
  mask.labels(kPerson).colRange(0, 5).setTo(0);
  mask.instances[1].box = {27, 10, 15, 40};
  EXPECT_THAT(classes(altered({.merge_two = true}, mask)), ElementsAre("person", "dog"));
}

TEST(MaskFaults, OneInstanceAloneIsNotMerged) {
  InstanceSegmentation mask = three_things();
  mask.labels.setTo(0, mask.labels != 1);
  mask.instances.resize(1);
  EXPECT_EQ(area(altered({.merge_two = true}, mask), 1), kChair.area());
}

TEST(MaskFaults, InstancesShrinkAtEachEdgeAndTheSmallestAreGone) {
  const InstanceSegmentation mask = altered({.shrink_px = 4}, three_things());
  ASSERT_THAT(classes(mask), ElementsAre("chair", "person"));  // the dog was 8 pixels high
  EXPECT_EQ(area(mask, 1), 12 * 12);
  EXPECT_EQ(area(mask, 2), 12 * 32);
  EXPECT_EQ(mask.instances[1].box, cv::Rect2f(26, 14, 12, 32));
  EXPECT_EQ(cv::countNonZero(mask.labels), 12 * 12 + 12 * 32);
}

TEST(MaskFaults, NothingShrinksAtTheEdgeOfTheImage) {
  InstanceSegmentation mask;
  mask.labels = cv::Mat(20, 20, CV_8UC1, cv::Scalar(1));
  mask.labels.colRange(10, 20).setTo(0);
  mask.instances.push_back({"person", 1.0F, {0, 0, 10, 20}, MotionVerdict::kUnknown});
  EXPECT_EQ(area(altered({.shrink_px = 3}, mask), 1), 7 * 20);
}

TEST(MaskFaults, EverySecondMaskHasOneWrongClassEachInTurn) {
  MaskFaultInjector injector({.swap_class_every = 2});
  std::array<std::vector<std::string>, 4> seen;
  for (auto& mask : seen) mask = classes(injector.apply(three_things()).value());
  EXPECT_THAT(seen[0], ElementsAre("chair", "person", "dog"));
  EXPECT_THAT(seen[1], ElementsAre("person", "person", "dog"));
  EXPECT_THAT(seen[2], ElementsAre("chair", "person", "dog"));
  EXPECT_THAT(seen[3], ElementsAre("chair", "chair", "dog"));
}

TEST(MaskFaults, AMaskWithoutInstancesIsLeftAlone) {
  InstanceSegmentation empty;
  empty.labels = cv::Mat(20, 20, CV_8UC1, cv::Scalar(0));
  const InstanceSegmentation mask = altered(
      {.drop_instance_every = 1, .merge_two = true, .shrink_px = 5, .swap_class_every = 1}, empty);
  EXPECT_THAT(mask.instances, IsEmpty());
  EXPECT_EQ(cv::countNonZero(mask.labels), 0);
}

TEST(FrameDelay, GivesBackWhatIsDueInOrder) {
  FrameDelay<char> delay(2);
  delay.put(10, 'a');
  EXPECT_EQ(delay.take_due(11), std::nullopt);
  delay.put(11, 'b');
  delay.put(13, 'c');  // 12 was passed over
  EXPECT_EQ(delay.take_due(13), 'a');
  EXPECT_EQ(delay.take_due(13), 'b');
  EXPECT_EQ(delay.take_due(13), std::nullopt);
  EXPECT_EQ(delay.take_due(15), 'c');
}

TEST(FrameDelay, WithoutDelayAllIsDueAtOnce) {
  FrameDelay<char> delay(0);
  delay.put(3, 'a');
  EXPECT_EQ(delay.take_due(3), 'a');
}

TEST(FrameDelay, ForgetsWhatItHoldsWhenTheCameraStartsAnew) {
  FrameDelay<char> delay(2);
  delay.put(100, 'a');
  EXPECT_EQ(delay.put(0, 'b'), 1U) << "frame 100's";
  EXPECT_EQ(delay.take_due(2), 'b');
  EXPECT_EQ(delay.take_due(102), std::nullopt);
}

}  // namespace
}  // namespace tsg
