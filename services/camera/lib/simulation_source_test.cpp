#include "services/camera/lib/simulation_source.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace tsg {
namespace {

using simulation::SceneDescription;
using simulation::Simulator;

constexpr std::int64_t kStartNs = 1'600'000'000'123'456'000;

SceneDescription empty_room() {
  SceneDescription scene;
  scene.name = "empty room";
  scene.duration_s = 0.2;
  simulation::RoomDescription room;
  room.max_m = {4.0, 3.0};
  scene.rooms.push_back(room);
  simulation::CameraWaypoint waypoint;
  waypoint.position_m = {0.5, 1.5, 1.4};
  waypoint.look_at_m = {3.0, 1.5, 1.2};
  scene.camera.waypoints.push_back(waypoint);
  scene.sensor.camera = scene.sensor.camera.resized(64, 48);
  return scene;
}

SimulationSource source_of(SceneEnd end) {
  return {value_or_throw(Simulator::build(empty_room())), kStartNs, end};
}

TEST(SimulationSource, HasTheFramesOfTheDurationStampedFromTheStart) {
  SimulationSource source = source_of(SceneEnd::kStop);
  EXPECT_EQ(source.info().camera, empty_room().sensor.camera);
  EXPECT_EQ(source.info().fps, 30.0);
  EXPECT_EQ(source.info().depth_units_per_metre, 5000.0);
  for (int i = 0; i < 6; ++i) {
    const auto frame = source.next();
    ASSERT_TRUE(frame && *frame) << i;
    EXPECT_NEAR(static_cast<double>((*frame)->stamp_ns() - kStartNs), i * 1e9 / 30.0, 1000.0);
  }
  const auto end = source.next();
  ASSERT_TRUE(end);
  EXPECT_EQ(*end, nullptr);
}

TEST(SimulationSource, GoesOnWhereItIsToAndRendersWhatTheSimulatorDoesWhateverIsSkipped) {
  SimulationSource source = source_of(SceneEnd::kGoOn);
  for (int i = 0; i < 20; ++i) ASSERT_NE(source.next().value(), nullptr) << i;
  const auto frame = source.next();
  cv::Mat colour(48, 64, CV_8UC3, cv::Scalar::all(0));
  cv::Mat depth(48, 64, CV_16UC1, cv::Scalar(0));
  const auto* const memory = colour.data;
  ASSERT_TRUE((*frame)->decode(colour, depth));
  EXPECT_EQ(colour.data, memory);
  const auto expected = value_or_throw(Simulator::build(empty_room())).render(20);
  EXPECT_EQ(cv::norm(colour, expected.colour, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(depth, expected.depth, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::countNonZero(depth), 64 * 48 / 2);
}

}  // namespace
}  // namespace tsg
