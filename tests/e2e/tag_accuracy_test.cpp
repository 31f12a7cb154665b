// How exactly the tag library knows the objects of a room that a camera goes round, with true poses
// and masks and a Kinect's noise, rendered small (320x240).

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>

#include "common/scene_file/scene_file.hpp"
#include "common/simulation/simulator.hpp"
#include "common/simulation/world/placement.hpp"
#include "services/map_server/lib/semantic_map.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

constexpr int kFrames = 24;

constexpr const char* kRoom = R"(
description: two chairs side by side, a table, a suitcase
duration_s: 24
rooms:
  - {name: room, min_m: [0, 0], max_m: [6, 5]}
objects:
  - {type: wooden_chair, name: left, at_m: [2.6, 1.9], yaw_deg: 90}
  - {type: wooden_chair, name: right, at_m: [3.2, 1.9], yaw_deg: 90}
  - {type: coffee_table, name: table, at_m: [2.9, 3.0], yaw_deg: 0}
  - {type: suitcase, name: suitcase, at_m: [4.1, 2.5], yaw_deg: 30}
camera:
  waypoints:
    - {at_s: 0, position_m: [2.9, 0.5, 1.4], look_at_m: [3.0, 2.3, 0.3]}
    - {at_s: 6, position_m: [5.3, 1.6, 1.5], look_at_m: [3.1, 2.4, 0.3]}
    - {at_s: 12, position_m: [3.6, 4.5, 1.5], look_at_m: [3.1, 2.4, 0.3]}
    - {at_s: 18, position_m: [0.8, 3.2, 1.4], look_at_m: [2.9, 2.4, 0.3]}
    - {at_s: 24, position_m: [1.5, 0.6, 1.4], look_at_m: [3.0, 2.3, 0.3]}
sensor: {width: 320, height: 240, rate_hz: 1}
)";

MapKeyframe keyframe_of(const simulation::Simulator& simulator,
                        const simulation::SimulatedFrame& frame,
                        int number) {
  MapKeyframe keyframe;
  keyframe.id = static_cast<std::uint64_t>(number);
  keyframe.T_world_camera = frame.T_world_camera;
  keyframe.frame = {
      static_cast<std::uint64_t>(number), frame.since_start_ns, simulator.scene().sensor.camera,
      simulation::kDepthUnitsPerMetre,    frame.colour,         frame.depth};
  keyframe.has_labels = true;
  frame.ids.convertTo(keyframe.instances.labels, CV_8U);
  for (const auto& instance : simulator.instances()) {  // ids are 1.. in this order
    keyframe.instances.instances.push_back({instance.class_name, 1.0F, {}, MotionVerdict::kStatic});
  }
  return keyframe;
}

/// The box of an object along the axes of the scene.
Eigen::AlignedBox3f true_box(const simulation::PlacedObject& object) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : object.model.mesh.points) {
    box.extend((object.T_world_object * point.cast<double>()).cast<float>());
  }
  return box;
}

TEST(TagAccuracy, KnowsTheObjectsOfARoomThatTheCameraGoesRound) {
  const test::TempFolder folder;
  const auto path = folder / "room.yaml";
  std::ofstream(path) << kRoom;
  const auto scene = value_or_throw(load_scene(path));
  auto simulator = value_or_throw(simulation::Simulator::build(scene));
  SemanticMap map{MapConfig{}};
  for (int i = 0; i < kFrames; ++i) {
    ASSERT_TRUE(map.integrate(keyframe_of(simulator, simulator.render(i), i)));
  }
  std::map<std::string, int> surplus;
  for (const Tag& tag : map.tags().tags()) surplus[tag.class_name] += is_present(tag) ? 1 : 0;
  for (const auto& object : value_or_throw(simulation::place_objects(scene))) {
    SCOPED_TRACE(object.description.name);
    --surplus[object.model.class_name];
    const Eigen::AlignedBox3f box = true_box(object);
    const auto& tags = map.tags().tags();
    const auto error = [&box](const Tag& tag) { return (tag.box.center() - box.center()).norm(); };
    const auto tag = std::min_element(
        tags.begin(), tags.end(), [&](const Tag& a, const Tag& b) { return error(a) < error(b); });
    ASSERT_NE(tag, tags.end());
    EXPECT_EQ(tag->class_name, object.model.class_name);
    EXPECT_LE(error(*tag), 0.05F);
    const float size_error = (tag->box.sizes() - box.sizes()).norm() / box.sizes().norm();
    EXPECT_LE(size_error, 0.15F);
    RecordProperty(object.description.name + "_centre_error_m", std::to_string(error(*tag)));
    RecordProperty(object.description.name + "_size_error", std::to_string(size_error));
  }
  for (const auto& [class_name, count] : surplus) EXPECT_EQ(count, 0) << class_name;
}

}  // namespace
}  // namespace tsg
