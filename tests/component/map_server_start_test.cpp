// What stops tsg-map-server before it touches the bus, and the bus that is not there: no RouDi.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/component/map_server_process.hpp"

namespace tsg::test {
namespace {

using ::testing::HasSubstr;

TEST(MapServerStart, WithoutRouDiSaysSoAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  MapServerProcess server;
  EXPECT_EQ(server.exit_code(), 69);
  EXPECT_THAT(server.log(), HasSubstr("RouDi"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(MapServerStart, WithAnUnknownKeyNamesIt) {
  MapServerProcess server({"--set", "map_server.resolutoin_m=0.1"});
  EXPECT_EQ(server.exit_code(), 78);
  EXPECT_THAT(server.log(), HasSubstr("resolutoin_m"));
}

TEST(MapServerStart, WithValuesOutOfRangeListsThemAll) {
  MapServerProcess server({"--set", "map_server.resolution_m=0", "--set",
                           "map_server.depth.max_depth_m=0.1", "--check-config"});
  EXPECT_EQ(server.exit_code(), 78);
  EXPECT_THAT(server.log(), HasSubstr("resolution_m must be"));
  EXPECT_THAT(server.log(), HasSubstr("max_depth_m must be"));
}

TEST(MapServerStart, ChecksItsConfigurationWithoutTheBus) {
  MapServerProcess server({"--check-config"});
  EXPECT_EQ(server.exit_code(), 0);
}

}  // namespace
}  // namespace tsg::test
