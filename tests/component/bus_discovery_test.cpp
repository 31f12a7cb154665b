#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "common/bus/diagnostics.hpp"
#include "common/bus/discovery.hpp"
#include "tests/support/test_bus.hpp"
#include "tests/support/wait.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;

std::optional<TopicInfo> find_topic(Bus& bus, const std::string& name) {
  const auto topics = discover_topics(bus, 0ms);
  const auto found = std::find_if(topics.begin(), topics.end(),
                                  [&](const TopicInfo& topic) { return topic.name == name; });
  if (found == topics.end()) return std::nullopt;
  return *found;
}

TEST(Discovery, ListsTopicsOfBothDomainsWithTheirProcesses) {
  TestBus other;
  Bus own{BusConfig{}};
  static_cast<void>(other.publisher<topics::Rgbd>());
  static_cast<void>(other.subscriber<topics::Rgbd>());
  const Subscriber<topics::Rgbd> second(other.bus());
  static_cast<void>(other.publisher<topics::Pose>());

  ASSERT_TRUE(eventually(5s, [&] {
    const auto rgbd = find_topic(own, "tsg/rgbd");
    return rgbd && rgbd->readers.size() == 2;
  }));
  const auto rgbd = find_topic(own, "tsg/rgbd");
  EXPECT_EQ(rgbd->type, "tsg::RgbdFrame");
  EXPECT_EQ(rgbd->domain_id, 10);
  ASSERT_EQ(rgbd->writers.size(), 1U);
  EXPECT_EQ(rgbd->writers[0].pid, ::getpid());
  EXPECT_FALSE(rgbd->writers[0].process.empty());
  EXPECT_FALSE(rgbd->writers[0].host.empty());
  EXPECT_EQ(rgbd->writers[0].transport, Transport::kSharedMemory);

  ASSERT_TRUE(eventually(5s, [&] { return find_topic(own, "rt/tsg/pose").has_value(); }));
  const auto pose = find_topic(own, "rt/tsg/pose");
  EXPECT_EQ(pose->type, "geometry_msgs::msg::dds_::PoseStamped_");
  EXPECT_EQ(pose->domain_id, 0);
  EXPECT_EQ(pose->writers[0].transport, Transport::kUdp);
  EXPECT_TRUE(pose->readers.empty());
}

TEST(Discovery, LeavesOutOwnEndpoints) {
  TestBus own;
  static_cast<void>(own.publisher<topics::Keyframe>());
  EXPECT_FALSE(find_topic(own.bus(), "tsg/keyframe"));
}

TEST(Discovery, ForgetsWhatIsGone) {
  TestBus own;
  {
    TestBus other;
    static_cast<void>(other.publisher<topics::Instances>());
    ASSERT_TRUE(eventually(5s, [&] { return find_topic(own.bus(), "tsg/instances").has_value(); }));
  }
  EXPECT_TRUE(eventually(5s, [&] { return !find_topic(own.bus(), "tsg/instances"); }));
}

TEST(Diagnostics, ArriveWithNameLevelAndValues) {
  TestBus bus;
  auto& subscriber = bus.subscriber<topics::Diagnostics>();
  DiagnosticsPublisher publisher(bus.bus(), "camera");
  ASSERT_TRUE(subscriber.wait_for_publishers(1, 5s));
  EXPECT_TRUE(publisher.is_due());
  ASSERT_TRUE(publisher.publish({.level = DiagnosticLevel::kWarn,
                                 .message = "frames are late",
                                 .values = {{"rate_hz", "29.9"}, {"dropped", "3"}}}));
  EXPECT_FALSE(publisher.is_due());
  const auto received = subscriber.take({}, 5s);
  ASSERT_TRUE(received);
  const auto diagnostics = to_diagnostics(**received);
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics[0].name, "camera");
  EXPECT_EQ(diagnostics[0].diagnostic.level, DiagnosticLevel::kWarn);
  EXPECT_EQ(diagnostics[0].diagnostic.message, "frames are late");
  ASSERT_EQ(diagnostics[0].diagnostic.values.size(), 2U);
  EXPECT_EQ(diagnostics[0].diagnostic.values[1].second, "3");
  EXPECT_GT(diagnostics[0].stamp_ns, 1'600'000'000'000'000'000);
}

}  // namespace
}  // namespace tsg::test
