// Sections camera and sensor.
#include <algorithm>

#include "common/dataset/trajectory.hpp"
#include "common/scene_file/scene_sections.hpp"

namespace tsg {
namespace {

using simulation::CameraPathDescription;
using simulation::CameraWaypoint;
using simulation::RoomDescription;
using simulation::SceneDescription;
using simulation::SensorDescription;

constexpr double kMilli = 1e-3;
constexpr Limits kIntrinsics{1.0, 10'000.0};

/// Strictly inside: a camera in a wall sees nothing.
bool is_inside(const SceneDescription& scene, const Eigen::Vector3d& position_m) {
  const auto contains = [&](const RoomDescription& room) {
    const Eigen::Array2d xy = position_m.head<2>();
    return (xy > room.min_m.array()).all() && (xy < room.max_m.array()).all() &&
           position_m.z() > 0.0 && position_m.z() < room.height_m;
  };
  return scene.rooms.empty() || std::ranges::any_of(scene.rooms, contains);
}

void check_waypoint(MapReader& reader, const SceneDescription& scene, const CameraWaypoint& point) {
  if (!is_inside(scene, point.position_m)) {
    reader.add_problem("position_m", "is outside all rooms");
  }
  if ((point.look_at_m - point.position_m).norm() < 0.05) {
    reader.add_problem("look_at_m", "must be at least 0.05 m from position_m");
  }
  const auto& before = scene.camera.waypoints;
  if (!before.empty() && point.at_s <= before.back().at_s) {
    reader.add_problem("at_s", "must be later than that of the waypoint before");
  }
}

void read_waypoints(MapReader& camera, SceneContext& context, SceneDescription& scene) {
  for (const ListItem& item : camera.list("waypoints")) {
    MapReader reader(item.node, item.path, context.problems);
    CameraWaypoint waypoint;
    const bool complete = reader.require({"at_s", "position_m", "look_at_m"});
    reader.read("at_s", waypoint.at_s, kSeconds);
    reader.read("position_m", waypoint.position_m);
    reader.read("look_at_m", waypoint.look_at_m);
    reader.read_scaled("roll_deg", waypoint.roll_rad, kDegrees, kRadians);
    reader.finish();
    if (complete) check_waypoint(reader, scene, waypoint);
    scene.camera.waypoints.push_back(waypoint);
  }
}

void check_trajectory(MapReader& camera, const SceneDescription& scene) {
  const auto trajectory = read_trajectory(scene.camera.trajectory_file);
  if (!trajectory) {
    camera.add_problem("trajectory_file", trajectory.error().message);
    return;
  }
  const auto outside = std::ranges::find_if(*trajectory, [&](const StampedPose& pose) {
    return !is_inside(scene, pose.T_world_camera.translation());
  });
  if (outside != trajectory->end()) {
    camera.add_problem("trajectory_file",
                       "its pose " + std::to_string(outside - trajectory->begin() + 1) +
                           " is outside all rooms; bring it into the axes of the scene");
  }
}

void read_trajectory_file(MapReader& camera, SceneContext& context, SceneDescription& scene) {
  std::string name;
  camera.read("trajectory_file", name);
  if (name.empty()) return;
  scene.camera.trajectory_file = context.folder / name;
  check_trajectory(camera, scene);
}

void read_covers(MapReader& camera, SceneContext& context, CameraPathDescription& path) {
  for (const ListItem& item : camera.list("covered_s")) {
    const auto times = read_numbers(item, 2, kSeconds, context.problems);
    if (!times) continue;
    if (times->at(0) < times->at(1)) {
      path.covered_s.emplace_back(times->at(0), times->at(1));
    } else {
      context.problems.add(item.line(), item.path, "must end after it begins");
    }
  }
}

void read_intrinsics(MapReader& reader, SensorDescription& sensor) {
  CameraModel& camera = sensor.camera;
  int width = camera.width;
  int height = camera.height;
  reader.read("width", width, {16, 1280});
  reader.read("height", height, {16, 720});
  camera = camera.resized(width, height);
  const std::vector<std::string> keys{"fx", "fy", "cx", "cy"};
  const auto given = std::ranges::count_if(keys, [&](const auto& key) { return reader.has(key); });
  if (given != 0 && given != 4) reader.add_problem("", "needs all of fx, fy, cx and cy, or none");
  reader.read("fx", camera.fx, kIntrinsics);
  reader.read("fy", camera.fy, kIntrinsics);
  reader.read("cx", camera.cx, {0.0, static_cast<double>(width - 1)});
  reader.read("cy", camera.cy, {0.0, static_cast<double>(height - 1)});
}

void read_switches(MapReader& reader, SensorDescription& sensor) {
  reader.read("depth_noise", sensor.depth_noise);
  reader.read("depth_quantisation", sensor.depth_quantisation);
  reader.read("depth_holes", sensor.depth_holes);
  reader.read("depth_range", sensor.depth_range);
  reader.read("colour_noise", sensor.colour_noise);
  reader.read("exposure_drift", sensor.exposure_drift);
  reader.read("vignetting", sensor.vignetting);
  reader.read("motion_blur", sensor.motion_blur);
  reader.read("rolling_shutter", sensor.rolling_shutter);
}

}  // namespace

void read_camera(MapReader& root, SceneContext& context, SceneDescription& scene) {
  if (!root.require({"camera"})) return;
  auto reader = root.map("camera");
  if (!reader) return;
  if (reader->has("waypoints") == reader->has("trajectory_file")) {
    reader->add_problem("", "needs either waypoints or trajectory_file");
  }
  read_waypoints(*reader, context, scene);
  if (reader->is_list("waypoints") && scene.camera.waypoints.empty()) {
    reader->add_problem("waypoints", "must have at least one");
  }
  read_trajectory_file(*reader, context, scene);
  reader->read_scaled("tremor_position_mm", scene.camera.tremor_position_m, {0.0, 100.0}, kMilli);
  reader->read_scaled("tremor_rotation_deg", scene.camera.tremor_rotation_rad, {0.0, 10.0},
                      kRadians);
  read_covers(*reader, context, scene.camera);
  reader->finish();
}

void read_sensor(MapReader& root, SceneContext& /*context*/, SceneDescription& scene) {
  auto reader = root.map("sensor");
  if (!reader) return;
  SensorDescription& sensor = scene.sensor;
  read_intrinsics(*reader, sensor);
  reader->read("rate_hz", sensor.rate_hz, {1.0, 120.0});
  reader->read("min_depth_m", sensor.min_depth_m, {0.05, 10.0});
  reader->read("max_depth_m", sensor.max_depth_m, {0.1, 13.0});
  if (sensor.max_depth_m <= sensor.min_depth_m) {
    reader->add_problem("max_depth_m", "must be more than min_depth_m");
  }
  read_switches(*reader, sensor);
  reader->read_scaled("exposure_ms", sensor.exposure_s, {0.1, 100.0}, kMilli);
  reader->read_scaled("readout_ms", sensor.readout_s, {0.0, 100.0}, kMilli);
  reader->finish();
}

}  // namespace tsg
