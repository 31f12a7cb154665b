// Shipped scenes hold what their descriptions promise, as a camera sees it.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <set>

#include "common/scene_file/scene_file.hpp"
#include "common/simulation/simulator.hpp"

namespace tsg {
namespace {

using simulation::SceneDescription;
using simulation::Simulator;

SceneDescription small_scene(const std::string& name) {
  auto scene = value_or_throw(load_scene(TSG_SOURCE_DIR "/config/scenes/" + name + ".yaml"));
  scene.sensor.camera = scene.sensor.camera.resized(64, 48);
  return scene;
}

/// The part of an image that instances of a class cover.
double share_of(const std::string& class_name, Simulator& simulator, int frame) {
  std::set<int> ids_of_class;
  for (const auto& instance : simulator.instances()) {
    if (instance.class_name == class_name) ids_of_class.insert(instance.id);
  }
  const cv::Mat ids = simulator.render(frame).ids;
  const auto covered = std::count_if(ids.begin<std::uint16_t>(), ids.end<std::uint16_t>(),
                                     [&](int id) { return ids_of_class.contains(id); });
  return static_cast<double>(covered) / static_cast<double>(ids.total());
}

TEST(ShippedScene, CrowdCoversMostOfTheImageForTwoSeconds) {
  auto simulator = value_or_throw(Simulator::build(small_scene("crowd")));
  constexpr int kEvery = 6;  // frames: 0.2 s
  constexpr int kLooksInTwoSeconds = 11;
  int longest = 0;
  int covered_looks = 0;
  for (int frame = 0; frame < simulator.frame_count(); frame += kEvery) {
    covered_looks = share_of("person", simulator, frame) > 0.6 ? covered_looks + 1 : 0;
    longest = std::max(longest, covered_looks);
  }
  EXPECT_GE(longest, kLooksInTwoSeconds);
}

TEST(ShippedScene, DarkBlackoutIsBlindForASecondAndThenSeesAPlaceThatItHasSeen) {
  const SceneDescription scene = small_scene("dark_blackout");
  ASSERT_EQ(scene.camera.covered_s.size(), 1U);
  const auto [from_s, to_s] = scene.camera.covered_s.front();
  EXPECT_NEAR(to_s - from_s, 1.0, 1e-9);
  auto simulator = value_or_throw(Simulator::build(scene));
  const int middle = static_cast<int>(0.5 * (from_s + to_s) * scene.sensor.rate_hz);
  EXPECT_EQ(cv::countNonZero(simulator.render(middle).depth), 0);
  const SE3 T_world_now = simulator.T_world_camera(to_s + 2.0);
  const auto is_near = [&](double time_s) {
    const SE3 T_now_then = T_world_now.inverse() * simulator.T_world_camera(time_s);
    const Eigen::AngleAxisd turn(T_now_then.rotation());
    return T_now_then.translation().norm() < 0.3 && turn.angle() < 0.2;
  };
  bool has_been_here = false;
  for (int tenth = 0; 0.1 * tenth < from_s; ++tenth) has_been_here |= is_near(0.1 * tenth);
  EXPECT_TRUE(has_been_here);
}

}  // namespace
}  // namespace tsg
