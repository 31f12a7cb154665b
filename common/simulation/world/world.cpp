#include "common/simulation/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "common/simulation/furniture/room.hpp"
#include "common/simulation/people/easing.hpp"

namespace tsg::simulation {
namespace {

constexpr double kMotionWindowS = 1.0 / 60.0;  // to either side
constexpr double kStillM = 1e-3;               // in the window: 3 cm/s is no longer standing still
constexpr double kStillRad = 2e-3;
// Light is known at the corners of faces: where one lies hidden inside another part of the thing,
// no more than so much of its face is dark.
constexpr float kBodyLightGridM = 0.08F;

Prop prop_of(const PlacedObject& object) {
  return {.T_world_object = object.T_world_object,
          .seat = object.model.seat,
          .half_size_m = object.model.half_size_m,
          .grip_height_m = object.model.grip_height_m,
          .top_m = object.model.top_m};
}

Error clash(const std::string& name, const std::string& what, const std::string& other) {
  return {ExitCode::kBadData,
          "object '" + name + "' " + what + ", and " + other + " as well; keep one of both"};
}

/// That a thing is there to be relocated or moved, and that nobody else does so.
Expected<void> check_displaced(const SceneDescription& scene,
                               const std::map<std::string, Prop>& props,
                               const std::vector<std::string>& taken_by_people) {
  const auto check = [&](const std::string& name, const std::string& what) -> Expected<void> {
    if (!props.contains(name)) {
      return make_error(ExitCode::kBadData, "there is no object '" + name + "' that could be " +
                                                (what == "is relocated" ? "relocated" : "moved"));
    }
    if (std::ranges::find(taken_by_people, name) != taken_by_people.end()) {
      return tl::unexpected(clash(name, what, "moved by a person"));
    }
    return {};
  };
  for (const RelocationDescription& relocation : scene.relocations) {
    if (auto ok = check(relocation.object, "is relocated"); !ok) return ok;
  }
  for (const MoveDescription& move : scene.moves) {
    if (auto ok = check(move.object, "moves by itself"); !ok) return ok;
    const auto relocated =
        std::ranges::find(scene.relocations, move.object, &RelocationDescription::object);
    if (relocated != scene.relocations.end()) {
      return tl::unexpected(clash(move.object, "moves by itself", "is relocated"));
    }
  }
  return {};
}

FloorPose floor_pose_of(const SE3& T_support_object) {
  const Eigen::Vector3d front = T_support_object.rotation() * Eigen::Vector3d::UnitX();
  return {T_support_object.translation().head<2>(), std::atan2(front.y(), front.x())};
}

/// Where a move that has begun at `from` has led by `time_s`.
FloorPose moved(const FloorPose& from, const MoveDescription& move, double time_s) {
  const double share = eased((time_s - move.from_s) / (move.to_s - move.from_s));
  return {mixed_values(from.position_m, move.to_m.value_or(from.position_m), share),
          mixed_values(from.yaw_rad, move.yaw_rad.value_or(from.yaw_rad), share)};
}

}  // namespace

Expected<World> World::build(const SceneDescription& scene) {
  const auto placed = place_objects(scene);
  if (!placed) return tl::unexpected(placed.error());
  std::map<std::string, Prop> props;
  for (const PlacedObject& object : *placed) props[object.description.name] = prop_of(object);
  auto choreography = Choreography::plan(scene.people, props, scene.seed);
  if (!choreography) return tl::unexpected(choreography.error());
  const std::vector<std::string> taken = choreography->moved_objects();
  if (const auto ok = check_displaced(scene, props, taken); !ok) {
    return tl::unexpected(ok.error());
  }
  World world(std::move(*choreography));
  for (const PlacedObject& object : *placed) {
    world.objects_[object.description.name] = {
        .on = object.description.on,
        .T_support_object = object.T_support_object,
        .relocations = {},
        .moves = {},
        .is_taken_by_people = std::ranges::find(taken, object.description.name) != taken.end()};
  }
  for (const RelocationDescription& relocation : scene.relocations) {
    world.objects_.at(relocation.object).relocations.push_back(relocation);
  }
  for (const MoveDescription& move : scene.moves) {
    world.objects_.at(move.object).moves.push_back(move);
  }
  for (auto& [name, object] : world.objects_) {
    std::ranges::sort(object.relocations, {}, &RelocationDescription::at_s);
  }
  Building building = make_building(scene);
  world.fixed_.push_back({std::move(building.shell), 0});
  world.lamps_ = std::move(building.lamps);
  for (const PlacedObject& object : *placed) world.add_object(object);
  world.add_people(scene.people);
  return world;
}

int World::add_instance(const std::string& class_name, const std::string& name, bool is_dynamic) {
  const int id = static_cast<int>(instances_.size()) + 1;
  instances_.push_back(
      {.id = id, .class_name = class_name, .name = name, .is_dynamic = is_dynamic});
  return id;
}

void World::add_object(const PlacedObject& object) {
  const std::string& name = object.description.name;
  const bool moves = is_moved(name);
  const int id = add_instance(object.model.class_name, name, moves);
  shapes_.emplace_back();
  for (const Eigen::Vector3f& point : object.model.mesh.points) shapes_.back().extend(point);
  render::Part part{.mesh = {}, .tag = static_cast<std::uint16_t>(id)};
  if (moves) {
    part.mesh = render::subdivided(object.model.mesh, kBodyLightGridM);
    // People come behind all things: their order in the choreography is theirs among the bodies.
    bodies_.push_back(std::move(part));
    moved_.push_back(name);
  } else {
    part.mesh.append(object.model.mesh, object.T_world_object);
    fixed_.push_back(std::move(part));
  }
}

void World::add_people(const std::vector<PersonDescription>& people) {
  for (std::size_t i = 0; i < people.size(); ++i) {
    const int id = add_instance("person", people[i].name, true);
    bodies_.push_back({choreography_.mesh(i), static_cast<std::uint16_t>(id)});
  }
}

void World::pose_body(std::size_t body,
                      double time_s,
                      std::vector<Eigen::Vector3f>& points,
                      std::vector<Eigen::Vector3f>& normals) const {
  if (body >= moved_.size()) {
    choreography_.pose(body - moved_.size(), time_s, points, normals);
    return;
  }
  const render::Mesh& mesh = bodies_[body].mesh;
  const SE3 T_world_body = T_world_object(moved_[body], time_s);
  const Eigen::Matrix3f R_world_body = T_world_body.rotation_matrix().cast<float>();
  const Eigen::Vector3f t_world_body = T_world_body.translation().cast<float>();
  points.resize(mesh.points.size());
  normals.resize(mesh.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = R_world_body * mesh.points[i] + t_world_body;
    normals[i] = R_world_body * mesh.normals[i];
  }
}

SE3 World::T_world_object(const std::string& name, double time_s) const {
  const Standing& object = objects_.at(name);
  if (object.is_taken_by_people) return choreography_.T_world_object(name, time_s);
  if (object.on.empty()) return object.T_support_object_at(time_s);
  return T_world_object(object.on, time_s) * object.T_support_object_at(time_s);
}

std::vector<ObjectBox> World::object_boxes(double time_s) const {
  std::vector<ObjectBox> boxes;
  for (std::size_t i = 0; i < shapes_.size(); ++i) {  // objects have the first ids
    const SE3 T_world_object = this->T_world_object(instances_[i].name, time_s);
    boxes.push_back({.id = instances_[i].id,
                     .centre_m = T_world_object * shapes_[i].center().cast<double>(),
                     .size_m = shapes_[i].sizes().cast<double>(),
                     .yaw_rad = floor_pose_of(T_world_object).yaw_rad});
  }
  return boxes;
}

bool World::is_person(int id) const { return static_cast<std::size_t>(id) > shapes_.size(); }

SE3 World::Standing::T_support_object_at(double time_s) const {
  const double z_m = T_support_object.translation().z();
  if (!moves.empty()) {
    FloorPose pose = floor_pose_of(T_support_object);
    for (const MoveDescription& move : moves) {
      if (time_s > move.from_s) pose = moved(pose, move, time_s);
    }
    return pose_at(pose, z_m);
  }
  const auto next = std::ranges::upper_bound(relocations, time_s, {}, &RelocationDescription::at_s);
  return next == relocations.begin() ? T_support_object : pose_at(std::prev(next)->to, z_m);
}

bool World::is_moved(const std::string& name) const {
  const Standing& object = objects_.at(name);
  return object.moves_itself() || (!object.on.empty() && is_moved(object.on));
}

bool World::is_moving(const std::string& name, double time_s) const {
  const SE3 T_before_after = T_world_object(name, time_s - kMotionWindowS).inverse() *
                             T_world_object(name, time_s + kMotionWindowS);
  return T_before_after.translation().norm() > kStillM || T_before_after.angle() > kStillRad;
}

std::vector<int> World::moving(double time_s) const {
  std::vector<int> ids;
  for (const SimulatedInstance& instance : instances_) {
    if (!instance.is_dynamic) continue;
    if (!objects_.contains(instance.name) || is_moving(instance.name, time_s)) {
      ids.push_back(instance.id);
    }
  }
  return ids;
}

}  // namespace tsg::simulation
