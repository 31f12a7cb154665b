#include "services/segmentation/lib/remote/frames_under_way.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

constexpr std::int64_t kPatienceNs = 100;

SentFrame sent(std::uint64_t seq, std::int64_t sent_ns) {
  return {.seq = seq, .stamp_ns = 1000 + static_cast<std::int64_t>(seq), .sent_ns = sent_ns};
}

TEST(FramesUnderWay, AreNoMoreThanIsAllowed) {
  FramesUnderWay frames(2, kPatienceNs);
  EXPECT_TRUE(frames.has_room(0));
  frames.add(sent(1, 0));
  EXPECT_TRUE(frames.has_room(10));
  frames.add(sent(2, 10));
  EXPECT_FALSE(frames.has_room(20));
  EXPECT_EQ(frames.awaited(20), 2U);
  ASSERT_TRUE(frames.take(1, 0).has_value());
  EXPECT_TRUE(frames.has_room(30));
}

TEST(FramesUnderWay, LeaveTheirPlaceAfterAWhileButAreAnsweredLate) {
  FramesUnderWay frames(1, kPatienceNs);
  frames.add(sent(1, 0));
  EXPECT_FALSE(frames.has_room(99));
  EXPECT_FALSE(frames.is_silent(99));
  EXPECT_TRUE(frames.has_room(100));
  EXPECT_TRUE(frames.is_silent(100));
  frames.add(sent(2, 100));
  const auto late = frames.take(1, 0);
  ASSERT_TRUE(late.has_value());
  EXPECT_EQ(late->frame.stamp_ns, 1001);
  EXPECT_EQ(late->overtaken, 0U);
  EXPECT_FALSE(frames.is_silent(150)) << "frame 2 may still be answered in time";
  EXPECT_TRUE(frames.is_silent(200));
}

TEST(FramesUnderWay, AreForgottenWhenALaterOneIsAnswered) {
  FramesUnderWay frames(3, kPatienceNs);
  for (std::uint64_t seq = 1; seq <= 3; ++seq)
    frames.add(sent(seq, static_cast<std::int64_t>(seq)));
  const auto answered = frames.take(2, 2);
  ASSERT_TRUE(answered.has_value());
  EXPECT_EQ(answered->overtaken, 1U);
  EXPECT_FALSE(frames.take(1, 1).has_value()) << "older than what was answered";
  EXPECT_FALSE(frames.take(2, 2).has_value()) << "answered twice";
  EXPECT_TRUE(frames.take(3, 3).has_value());
}

TEST(FramesUnderWay, AreNotTakenForThoseOfAnotherSender) {
  FramesUnderWay frames(1, kPatienceNs);
  frames.add(sent(1, 5));
  EXPECT_FALSE(frames.take(1, 6).has_value());
  EXPECT_FALSE(frames.take(2, 5).has_value());
  EXPECT_TRUE(frames.take(1, 5).has_value());
}

TEST(FramesUnderWay, GiveTheirPlaceBackWhereTheyCouldNotBeSent) {
  FramesUnderWay frames(2, kPatienceNs);
  frames.add(sent(1, 1));
  frames.add(sent(2, 2));
  frames.remove(2, 2);
  EXPECT_TRUE(frames.has_room(3));
  EXPECT_FALSE(frames.take(2, 2).has_value());
  EXPECT_EQ(frames.take(1, 1)->overtaken, 0U);
}

TEST(FramesUnderWay, AreForgottenOneByOneWhereNobodyEverAnswers) {
  FramesUnderWay frames(1, kPatienceNs);
  std::size_t forgotten = 0;
  for (std::uint64_t seq = 0; seq < 1000; ++seq) {
    forgotten += frames.add(sent(seq, static_cast<std::int64_t>(seq) * kPatienceNs));
  }
  EXPECT_GT(forgotten, 900U);
  EXPECT_FALSE(frames.take(0, 0).has_value());
}

}  // namespace
}  // namespace tsg
