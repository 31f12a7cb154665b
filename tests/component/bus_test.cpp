#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "tests/support/test_bus.hpp"
#include "tests/support/wait.hpp"

namespace tsg {

// Topics that nobody should write: to see how the bus takes it.
struct TextOnSharedMemory {
  using Message = tsg_Reply;
  static constexpr const char* kName = "test/text_on_shared_memory";
  static constexpr Qos kQos{.domain = Domain::kSharedMemory, .keep_last = 4};
};

}  // namespace tsg

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

void publish_seq(Publisher<topics::Rgbd>& publisher, std::uint64_t seq) {
  auto loan = publisher.loan();
  ASSERT_TRUE(loan) << loan.error().message;
  (*loan)->header.seq = seq;
  ASSERT_TRUE(publisher.publish(std::move(*loan)));
}

TEST(Bus, CountsTheSamplesThatASlowReaderMissed) {
  TestBus bus;
  auto& publisher = bus.publisher<topics::Rgbd>();
  auto& subscriber = bus.subscriber<topics::Rgbd>();
  ASSERT_TRUE(publisher.wait_for_subscribers(1, 5s));
  publish_seq(publisher, 0);
  ASSERT_TRUE(subscriber.take({}, 5s));
  for (std::uint64_t seq = 1; seq <= 20; ++seq) publish_seq(publisher, seq);

  std::uint64_t received = 0;
  std::uint64_t last = 0;
  while (last != 20) {
    const auto sample = subscriber.take({}, 5s);
    ASSERT_TRUE(sample);
    last = (*sample)->header.seq;
    ++received;
  }
  EXPECT_EQ(subscriber.missed(), 20 - received);
  EXPECT_GE(subscriber.missed(), 1U);
}

TEST(Bus, TakesAPublisherThatStartsAnewForNoHole) {
  TestBus bus;
  auto& publisher = bus.publisher<topics::Rgbd>();
  auto& subscriber = bus.subscriber<topics::Rgbd>();
  ASSERT_TRUE(publisher.wait_for_subscribers(1, 5s));
  for (const std::uint64_t seq : {100U, 0U, 1U}) {
    publish_seq(publisher, seq);
    ASSERT_TRUE(subscriber.take({}, 5s));
  }
  EXPECT_EQ(subscriber.missed(), 0U);
}

TEST(Bus, TakeLatestPassesOverWhatIsOlder) {
  TestBus bus;
  auto& publisher = bus.publisher<topics::Rgbd>();
  auto& subscriber = bus.subscriber<topics::Rgbd>();
  ASSERT_TRUE(publisher.wait_for_subscribers(1, 5s));
  for (std::uint64_t seq = 0; seq < 3; ++seq) publish_seq(publisher, seq);
  std::uint64_t taken = 0;
  std::uint64_t last = 0;
  while (last != 2) {
    const auto newest = subscriber.take_latest({}, 5s);
    ASSERT_TRUE(newest);
    last = (*newest)->header.seq;
    ++taken;
  }
  EXPECT_EQ(subscriber.passed_over() + taken, 3U);
  EXPECT_EQ(subscriber.missed(), 0U);
}

/// Loans from `publisher` until it gives no more.
std::vector<Loan<topics::Rgbd>> loan_all(Publisher<topics::Rgbd>& publisher) {
  std::vector<Loan<topics::Rgbd>> held;
  for (auto loan = publisher.loan(); loan; loan = publisher.loan()) {
    held.push_back(std::move(*loan));
  }
  return held;
}

TEST(Bus, AnEmptyPoolIsUnavailableAndRecovers) {
  TestBus bus;
  std::vector<std::unique_ptr<Publisher<topics::Rgbd>>> publishers;
  std::vector<std::vector<Loan<topics::Rgbd>>> held;
  do {  // several publishers: one may not hold as much as the pool has
    publishers.push_back(std::make_unique<Publisher<topics::Rgbd>>(bus.bus()));
    held.push_back(loan_all(*publishers.back()));
  } while (!held.back().empty() && publishers.size() < 20);

  // What earlier readers held may still be on its way back to the pool.
  Expected<Loan<topics::Rgbd>> refused = publishers.back()->loan();
  for (int late = 0; refused && late < 24; ++late) {
    held.back().push_back(std::move(*refused));
    refused = publishers.back()->loan();
  }
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ExitCode::kUnavailable);
  held.clear();
  EXPECT_TRUE(publishers.back()->loan());
}

TEST(Bus, ALoanTooManyIsUnavailableUntilOneIsGivenBack) {
  TestBus bus;
  auto& publisher = bus.publisher<topics::Rgbd>();
  auto held = loan_all(publisher);
  EXPECT_GE(held.size(), 4U);
  const auto refused = publisher.loan();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ExitCode::kUnavailable);
  EXPECT_THAT(refused.error().message, HasSubstr("tsg/rgbd"));
  held.pop_back();
  EXPECT_TRUE(publisher.loan());
}

TEST(Bus, LoansAndSamplesGoBackToThePool) {
  TestBus bus;
  auto& publisher = bus.publisher<topics::Rgbd>();
  auto& subscriber = bus.subscriber<topics::Rgbd>();
  ASSERT_TRUE(publisher.wait_for_subscribers(1, 5s));
  for (std::uint64_t seq = 0; seq < 200; ++seq) {
    ASSERT_TRUE(publisher.loan());  // not published
    publish_seq(publisher, seq);
    ASSERT_TRUE(subscriber.take({}, 5s));
  }
}

TEST(Bus, AStopRequestWakesAWaitingTake) {
  TestBus bus;
  auto& subscriber = bus.subscriber<topics::Rgbd>();
  const auto start = Clock::now();
  std::jthread taker([&](const std::stop_token& stop) {
    EXPECT_FALSE(subscriber.take(stop, std::chrono::hours(1)));
  });
  std::this_thread::sleep_for(50ms);  // so that it waits, most likely; right either way
  taker.request_stop();
  taker.join();
  EXPECT_LT(Clock::now() - start, 5s);
}

TEST(Bus, TakeGivesUpAfterItsTimeout) {
  TestBus bus;
  const auto start = Clock::now();
  EXPECT_FALSE(bus.subscriber<topics::Rgbd>().take({}, 100ms));
  EXPECT_GE(Clock::now() - start, 99ms);
  EXPECT_LT(Clock::now() - start, 5s);
}

TEST(Bus, WaitingForSubscribersEndsWithTimeoutOrStop) {
  TestBus bus;
  auto& publisher = bus.publisher<topics::Rgbd>();
  EXPECT_FALSE(publisher.wait_for_subscribers(1, 50ms));
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_FALSE(publisher.wait_for_subscribers(1, std::chrono::hours(1), stopped.get_token()));
}

TEST(Bus, KnowsHowManyAreOnTheOtherSide) {
  TestBus bus;
  auto& publisher = bus.publisher<topics::Rgbd>();
  EXPECT_EQ(publisher.subscriber_count(), 0);
  auto first = std::make_unique<Subscriber<topics::Rgbd>>(bus.bus());
  const Subscriber<topics::Rgbd> second(bus.bus());
  EXPECT_TRUE(publisher.wait_for_subscribers(2, 5s));
  EXPECT_TRUE(first->wait_for_publishers(1, 5s));
  EXPECT_EQ(second.publisher_count(), 1);
  first.reset();
  EXPECT_TRUE(eventually(5s, [&] { return publisher.subscriber_count() == 1; }));
}

TEST(Bus, ALateSubscriberGetsTheLatestMap) {
  TestBus bus;
  auto& publisher = bus.publisher<topics::Grid>();
  const std::string frame = "map";
  for (const std::uint32_t width : {1U, 2U, 3U}) {
    topics::Grid::Message grid{};
    grid.header.frame_id = lend(frame);
    grid.info.width = width;
    ASSERT_TRUE(publisher.publish(grid));
  }
  Subscriber<topics::Grid> late(bus.bus());
  const auto received = late.take({}, 5s);
  ASSERT_TRUE(received);
  EXPECT_EQ((*received)->info.width, 3U);
}

TEST(Bus, SaysLoudlyThatATopicIsNotOnSharedMemory) {
  TestBus bus;
  ::testing::internal::CaptureStderr();
  const Publisher<TextOnSharedMemory> publisher(bus.bus());
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_FALSE(publisher.is_on_shared_memory());
  EXPECT_THAT(said, HasSubstr("WARNING"));
  EXPECT_THAT(said, HasSubstr("test/text_on_shared_memory"));
  EXPECT_THAT(said, HasSubstr("NOT ON SHARED MEMORY"));
}

TEST(Bus, IsQuietWhereATopicIsOnSharedMemory) {
  TestBus bus;
  ::testing::internal::CaptureStderr();
  const Publisher<topics::Rgbd> publisher(bus.bus());
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Bus, TwoConfigurationsOfOneDomainInAProcessAreAnError) {
  TestBus bus;
  BusConfig other;
  other.use_shared_memory = false;
  try {
    const Bus second(other);
    FAIL() << "a second configuration of domain 10 was accepted";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kConfig);
  }
}

TEST(BusConfig, NamesEveryProblem) {
  const BusConfig config{.standard_domain = 500, .shared_memory_domain = 500, .interface = "<lo>"};
  EXPECT_EQ(config.problems().size(), 4U);
  EXPECT_TRUE(BusConfig{}.problems().empty());
}

}  // namespace
}  // namespace tsg::test
