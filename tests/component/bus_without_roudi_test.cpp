#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/roudi.hpp"
#include "tests/component/bus_examples.hpp"
#include "tests/support/test_bus.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

BusConfig without_shared_memory() {
  BusConfig config;
  config.use_shared_memory = false;
  return config;
}

TEST(BusWithoutRoudi, RefusesToStartAtOnceAndSaysWhatToDo) {
  if (check_roudi()) GTEST_SKIP() << "somebody runs RouDi on this host";
  const auto start = std::chrono::steady_clock::now();
  try {
    const Bus bus{BusConfig{}};
    FAIL() << "the bus came up without RouDi";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kUnavailable);
    EXPECT_THAT(error.what(), HasSubstr("RouDi"));
    EXPECT_THAT(error.what(), HasSubstr("iox-roudi -c"));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, 1s);
}

TEST(BusWithoutRoudi, SendsImagesOverUdpWhereAskedTo) {
  TestBus bus(without_shared_memory());
  auto& publisher = bus.publisher<topics::Rgbd>();
  auto& subscriber = bus.subscriber<topics::Rgbd>();
  EXPECT_FALSE(publisher.is_on_shared_memory());
  EXPECT_FALSE(subscriber.is_on_shared_memory());
  ASSERT_TRUE(publisher.wait_for_subscribers(1, 5s));
  auto loan = publisher.loan();
  ASSERT_TRUE(loan);
  fill_example(**loan);
  ASSERT_TRUE(publisher.publish(std::move(*loan)));
  const auto received = subscriber.take({}, 5s);
  ASSERT_TRUE(received);
  EXPECT_FALSE(received->is_zero_copy());
  const auto expected = std::make_unique<tsg_RgbdFrame>();
  fill_example(*expected);
  EXPECT_EQ((*received)->header.seq, expected->header.seq);
  EXPECT_EQ((*received)->colour[100'001], expected->colour[100'001]);
  EXPECT_EQ((*received)->depth[307'199], expected->depth[307'199]);
}

TEST(BusWithoutRoudi, SaysLoudlyThatImagesAreCopied) {
  TestBus bus(without_shared_memory());
  ::testing::internal::CaptureStderr();
  const Subscriber<topics::Keyframe> subscriber(bus.bus());
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr("WARNING"));
  EXPECT_THAT(said, HasSubstr("tsg/keyframe"));
  EXPECT_THAT(said, HasSubstr("use_shared_memory is false"));
}

TEST(BusWithoutRoudi, AnUnknownInterfaceIsNamed) {
  BusConfig config = without_shared_memory();
  config.standard_domain = 7;
  config.interface = "no-such-nic";
  try {
    const Bus bus(config);
    FAIL() << "the bus came up on an interface that does not exist";
  } catch (const FatalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no-such-nic"));
  }
}

}  // namespace
}  // namespace tsg::test
