#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/app/child_process.hpp"
#include "tests/component/bus_examples.hpp"
#include "tests/support/test_bus.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

std::string read(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Publishes the example of `Topic` once the other process is there.
template <typename Topic>
void publish_example(TestBus& bus) {
  typename Topic::Message message{};
  fill_example(message);
  ASSERT_TRUE(bus.publisher<Topic>().wait_for_subscribers(1, 10s)) << Topic::kName;
  ASSERT_TRUE(bus.publisher<Topic>().publish(message));
}

// A separate process with a separately written IDL and the DDS configuration that we ship for
// other programs.
TEST(Ros2Compatibility, ASubscriberWithItsOwnIdlReadsPoseOdometryAndTransforms) {
  BusConfig config;
  config.use_shared_memory = false;
  TestBus bus(config);
  const auto output = std::filesystem::temp_directory_path() / "ros2_subscriber.out";
  std::filesystem::remove(output);
  auto child = ChildProcess::spawn(
      {.program = TSG_BIN_DIR "/ros2_subscriber",
       .environment = {{"CYCLONEDDS_URI", "file://" TSG_SOURCE_DIR "/config/cyclonedds.xml"}},
       .output_file = output});
  ASSERT_TRUE(child);
  publish_example<topics::Pose>(bus);
  publish_example<topics::Odometry>(bus);
  publish_example<topics::Transforms>(bus);

  const auto& ended = child->wait(20s);
  ASSERT_TRUE(ended);
  const std::string said = read(output);
  EXPECT_TRUE(ended->is_success()) << ended->describe() << ", said: " << said;
  EXPECT_THAT(
      said, HasSubstr("pose map 1305031102.175304000 1.500 -2.500 3.500 0.100 0.200 0.300 0.900"));
  EXPECT_THAT(
      said, HasSubstr("odom odom 1305031102.175304000 1.500 -2.500 3.500 0.100 0.200 0.300 0.900"));
  EXPECT_THAT(said, HasSubstr("child camera covariance 0.250 0.125 twist 0.500 0.700 1.100"));
  EXPECT_THAT(said, HasSubstr("tf map->odom 1.000 2.000 3.000 turn 0.000 1.000"));
  EXPECT_THAT(said, HasSubstr("tf odom->camera 4.000 5.000 6.000 turn 1.000 0.000"));
}

}  // namespace
}  // namespace tsg::test
