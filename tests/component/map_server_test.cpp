// tsg-map-server as a process on the real bus: keyframes in, map files and replies out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <sys/mount.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "common/bus/command.hpp"
#include "common/bus/convert.hpp"
#include "common/bus/diagnostics.hpp"
#include "tests/component/map_server_process.hpp"
#include "tests/support/stop_limit.hpp"
#include "tests/support/test_bus.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A wall 2 m ahead with a tv on it and a person 1 m before it, seen from the origin.
void fill_wall(tsg_Keyframe& message, std::uint64_t seq) {
  RgbdFrame frame;
  frame.camera = {320, 240, 260.0, 260.0, 160.0, 120.0, {}};
  frame.depth_units_per_metre = 5000.0;
  frame.colour = cv::Mat(240, 320, CV_8UC3, cv::Scalar(40, 80, 120));
  frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(10100));
  InstanceSegmentation instances;
  instances.labels = cv::Mat(240, 320, CV_8UC1, cv::Scalar(0));
  instances.instances = {{"tv", 0.9F, {}, MotionVerdict::kStatic},
                         {"person", 0.9F, {}, MotionVerdict::kMoving}};
  const cv::Rect person(60, 60, 60, 180);
  frame.depth(person).setTo(5000);
  instances.labels(person).setTo(2);
  instances.labels(cv::Rect(200, 80, 60, 40)).setTo(1);
  throw_on_error(fill_message(frame, message));
  throw_on_error(fill_message(instances, message));
  message.header.seq = seq;
  message.id = seq;
  message.T_world_camera = to_message(SE3());
}

class MapServer : public ::testing::Test {
 protected:
  /// The n-th of 0, 1, ...
  void send(std::uint64_t seq) {
    ASSERT_TRUE(
        bus_.publish<topics::Keyframe>([seq](tsg_Keyframe& message) { fill_wall(message, seq); }));
  }

  Expected<std::string> ask(const std::string& verb, const json& argument) {
    return client_.call("map_server", verb, argument.dump(), 30s);
  }
  Expected<std::string> save(const fs::path& folder, int keyframes) {
    return ask("save_map", {{"folder", folder.string()}, {"keyframes", keyframes}});
  }
  json report() { return json::parse(value_or_throw(ask("report", json::object()))); }

  TestBus bus_;
  CommandClient client_{bus_.bus()};
  MapServerProcess server_;
  TempFolder out_;
};

TEST_F(MapServer, SavesAMapThatOctoMapReads) {
  for (std::uint64_t seq = 0; seq < 3; ++seq) send(seq);
  const auto saved = save(out_ / "new" / "folder", 3);
  ASSERT_TRUE(saved) << saved.error().message;
  const json reply = json::parse(*saved);
  EXPECT_EQ(reply["keyframes"], 3);
  EXPECT_EQ(reply["keyframes_outstanding"], 0);
  EXPECT_GT(reply["points_raw"], reply["points"]);
  ASSERT_EQ(reply["objects"].size(), 1U);
  EXPECT_EQ(reply["objects"][0]["class"], "tv");
  EXPECT_EQ(reply["objects"][0]["max_in_view"], 1);
  const fs::path folder = out_ / "new" / "folder";
  EXPECT_EQ(fs::file_size(folder / "map.ot"), reply["bytes_ot"]);
  EXPECT_EQ(fs::file_size(folder / "map.bt"), reply["bytes_bt"]);
  EXPECT_EQ(fs::file_size(folder / "cloud.ply"), reply["bytes_ply"]);

  const std::unique_ptr<octomap::AbstractOcTree> read(
      octomap::AbstractOcTree::read((folder / "map.ot").string()));
  auto* tree = dynamic_cast<octomap::ColorOcTree*>(read.get());
  ASSERT_NE(tree, nullptr);
  const auto* wall = tree->search(0.0, 0.0, 2.02);
  ASSERT_NE(wall, nullptr);
  EXPECT_TRUE(tree->isNodeOccupied(wall));
  EXPECT_EQ(wall->getColor(), octomap::ColorOcTreeNode::Color(120, 80, 40));
  const auto* person = tree->search(-0.27, 0.1, 1.0);
  EXPECT_TRUE(person == nullptr || !tree->isNodeOccupied(person));
  octomap::OcTree binary((folder / "map.bt").string());
  ASSERT_NE(binary.search(0.0, 0.0, 2.02), nullptr);
  EXPECT_TRUE(binary.isNodeOccupied(binary.search(0.0, 0.0, 2.02)));
}

TEST_F(MapServer, RejectsMalformedKeyframesAndLivesOn) {
  using Damage = void (*)(tsg_Keyframe&);
  const std::vector<std::pair<Damage, const char*>> cases{
      {[](tsg_Keyframe& m) { m.T_world_camera.tx = std::numeric_limits<double>::quiet_NaN(); },
       "NaN"},
      {[](tsg_Keyframe& m) { m.T_world_camera.ty = 1e9; }, "farther than 500 m"},
      {[](tsg_Keyframe& m) { std::fill_n(m.depth, 320 * 240, std::uint16_t{0}); }, "no depth"},
      {[](tsg_Keyframe& m) { m.intrinsics.width = 100000; }, "100000"}};
  std::uint64_t seq = 0;
  for (const auto& [damage, reason] : cases) {
    ASSERT_TRUE(bus_.publish<topics::Keyframe>([seq, damage = damage](tsg_Keyframe& message) {
      fill_wall(message, seq);
      damage(message);
    }));
    ++seq;
    ASSERT_TRUE(save(out_.path(), static_cast<int>(seq)));
    EXPECT_THAT(report()["last_rejection"].get<std::string>(), HasSubstr(reason));
  }
  send(seq);
  ASSERT_TRUE(save(out_.path(), static_cast<int>(seq) + 1));
  const json counts = report();
  EXPECT_EQ(counts["keyframes"], 1);
  EXPECT_EQ(counts["keyframes_rejected"], 4);
  EXPECT_THAT(server_.log(), HasSubstr("keyframe rejected"));
}

TEST_F(MapServer, AnswersAFullDiskAndDamagesNothing) {
  const fs::path disk = out_ / "disk";
  fs::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "a small disk needs root or user namespaces";
  }
  out_.write("disk/map.ot", "older");
  send(0);
  const auto saved = save(disk, 1);
  const std::string older = content_of(disk / "map.ot");
  const auto files = std::distance(fs::directory_iterator(disk), fs::directory_iterator());
  ASSERT_EQ(::umount(disk.c_str()), 0);
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, ExitCode::kCannotWrite);
  EXPECT_THAT(saved.error().message, HasSubstr("map.ot"));
  EXPECT_THAT(saved.error().message, HasSubstr("bytes are needed"));
  EXPECT_THAT(saved.error().message, HasSubstr("free some disk space"));
  EXPECT_EQ(older, "older");
  EXPECT_EQ(files, 1);
  EXPECT_TRUE(save(out_ / "elsewhere", 1));
}

TEST_F(MapServer, RefusesToSaveWithoutAFolderOrToAFile) {
  send(0);
  const auto nowhere = ask("save_map", {{"keyframes", 0}});
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ExitCode::kUsage);
  const auto negative = save(out_.path(), -1);
  ASSERT_FALSE(negative);
  EXPECT_THAT(negative.error().message, HasSubstr("-1"));
  const auto file = save(out_.write("file", "x"), 0);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ExitCode::kCannotWrite);
}

TEST_F(MapServer, CountsKeyframesThatAreLostInTheBusAsSettled) {
  send(0);
  send(5);  // 1 to 4 never come
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(save(out_.path(), 6));
  EXPECT_LT(std::chrono::steady_clock::now() - start, 15s);
  EXPECT_EQ(report()["keyframes_missed"], 4);
  EXPECT_THAT(server_.log(), HasSubstr("keyframes missed"));
}

TEST_F(MapServer, PublishesItsStateEverySecond) {
  ASSERT_TRUE(bus_.watch<topics::Diagnostics>());
  send(0);
  const auto state = bus_.wait_for<topics::Diagnostics>(5s, [](const auto& message) {
    const auto all = to_diagnostics(message);
    return std::any_of(all.begin(), all.end(), [](const NamedDiagnostic& named) {
      return named.name == "map_server" && named.diagnostic.message == "mapping";
    });
  });
  EXPECT_TRUE(state);
}

TEST_F(MapServer, StopsWithinTwoSecondsOfSigtermWhileKeyframesWait) {
  send(0);
  ASSERT_TRUE(save(out_.path(), 1));  // it works
  for (std::uint64_t seq = 1; seq < 8; ++seq) send(seq);
  server_.child().signal(SIGTERM);
  EXPECT_EQ(server_.exit_code(kStopLimit), 0);
  EXPECT_THAT(server_.log(), HasSubstr("stopped"));
}

}  // namespace
}  // namespace tsg::test
