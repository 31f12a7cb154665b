#include "common/core/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace tsg {
namespace {

TEST(BoundedQueue, DropsAndCountsTheOldestWhenAskedTo) {
  BoundedQueue<int> queue(2, WhenFull::kDropOldest);
  for (const int value : {1, 2, 3}) EXPECT_TRUE(queue.push(value));
  EXPECT_EQ(queue.dropped(), 1U);
  EXPECT_EQ(queue.try_pop(), 2);
  EXPECT_EQ(queue.try_pop(), 3);
  EXPECT_EQ(queue.try_pop(), std::nullopt);
}

TEST(BoundedQueue, BlockedPushReturnsWhenStopped) {
  BoundedQueue<int> queue(1, WhenFull::kBlock);
  ASSERT_TRUE(queue.push(1));
  bool added = true;
  {
    const std::jthread producer([&](const std::stop_token& stop) { added = queue.push(2, stop); });
  }
  EXPECT_FALSE(added);
  EXPECT_EQ(queue.size(), 1U);
}

TEST(BoundedQueue, BlockedPushGoesOnWhenRoomIsMade) {
  BoundedQueue<int> queue(1, WhenFull::kBlock);
  ASSERT_TRUE(queue.push(1));
  std::jthread producer([&] { EXPECT_TRUE(queue.push(2)); });
  const std::stop_source never;
  EXPECT_EQ(queue.pop(never.get_token()), 1);
  EXPECT_EQ(queue.pop(never.get_token()), 2);
}

TEST(BoundedQueue, HandsOutWhatIsQueuedAfterStopThenNothing) {
  BoundedQueue<int> queue(4, WhenFull::kBlock);
  std::stop_source stopped;
  ASSERT_TRUE(queue.push(1));
  stopped.request_stop();
  EXPECT_EQ(queue.pop(stopped.get_token()), 1);
  EXPECT_EQ(queue.pop(stopped.get_token()), std::nullopt);
}

}  // namespace
}  // namespace tsg
