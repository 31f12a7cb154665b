// Sections objects, relocations and moves.

#include "common/scene_file/scene_sections.hpp"

namespace tsg {
namespace {

using simulation::MoveDescription;
using simulation::ObjectDescription;
using simulation::RelocationDescription;
using simulation::SceneDescription;

constexpr double kBeyondWall = 0.3;  // metres; posters hang on a wall, things may stick into it
constexpr Limits kScale{0.1, 10.0};

void read_scale(MapReader& reader, ObjectDescription& object) {
  if (!reader.has("scale")) return;
  if (reader.is_list("scale")) {
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    reader.read("scale", scale, kScale);
    object.scale = {scale.x(), scale.y(), scale.z()};
  } else {
    double scale = 1.0;
    reader.read("scale", scale, kScale);
    object.scale = {scale, scale, scale};
  }
}

void check_place(MapReader& reader,
                 const SceneDescription& scene,
                 const ObjectDescription& object) {
  if (!object.on.empty()) {
    if (reader.has("height_m")) {
      reader.add_problem("height_m", "is for things on walls; what is `on` something needs none");
    }
    return;
  }
  if (reader.require({"at_m"}) && !is_in_a_room(scene, object.pose.position_m, kBeyondWall)) {
    reader.add_problem("at_m", "is outside all rooms");
  }
}

void declare(MapReader& reader, SceneContext& context, const std::string& name) {
  if (!name.empty()) context.names.declare_object(name, reader.line("name"), context.problems);
}

/// Where and when it goes.
void read_move(MapReader& reader, MoveDescription& move) {
  reader.read("object", move.object);
  reader.read("from_s", move.from_s, kSeconds);
  reader.read("to_s", move.to_s, kSeconds);
  if (reader.has("to_m")) {
    move.to_m = Eigen::Vector2d::Zero();
    reader.read("to_m", *move.to_m);
  }
  if (reader.has("yaw_deg")) {
    move.yaw_rad = 0.0;
    reader.read_scaled("yaw_deg", *move.yaw_rad, kDegrees, kRadians);
  }
  reader.finish();
}

void check_move(MapReader& reader, const SceneDescription& scene, const MoveDescription& move) {
  if (move.to_s <= move.from_s) reader.add_problem("to_s", "must be later than from_s");
  if (!move.to_m && !move.yaw_rad) reader.add_problem("", "needs to_m, yaw_deg or both");
  if (move.to_m && !is_in_a_room(scene, *move.to_m, kBeyondWall)) {
    reader.add_problem("to_m", "is outside all rooms");
  }
  for (const MoveDescription& earlier : scene.moves) {
    if (earlier.object == move.object && move.from_s < earlier.to_s) {
      reader.add_problem("from_s", "must not be before the end of the object's move before");
    }
  }
}

/// All but a name that the file gives.
void read_object(MapReader& reader,
                 SceneContext& context,
                 const SceneDescription& scene,
                 ObjectDescription& object) {
  reader.require({"type"});
  reader.read("type", object.type, context.catalogue.furniture);
  if (object.name.empty() && !object.type.empty()) {
    object.name = context.names.make_object_name(object.type);
    declare(reader, context, object.name);
  }
  if (reader.has("on")) {
    reader.read("on", object.on);
    context.names.stack(object.name, object.on, reader.line("on"), reader.path("on"));
  }
  reader.read("at_m", object.pose.position_m);
  reader.read_scaled("yaw_deg", object.pose.yaw_rad, kDegrees, kRadians);
  reader.read("height_m", object.height_m, {0.0, 20.0});
  reader.read("look", object.look);
  read_scale(reader, object);
  reader.finish();
  check_place(reader, scene, object);
}

}  // namespace

void read_objects(MapReader& root, SceneContext& context, SceneDescription& scene) {
  std::vector<MapReader> readers;
  for (const ListItem& item : root.list("objects")) {
    readers.emplace_back(item.node, item.path, context.problems);
  }
  scene.objects.resize(readers.size());
  // Names of the file first, so that none that is made up takes one of them.
  for (std::size_t i = 0; i < readers.size(); ++i) {
    readers[i].read("name", scene.objects[i].name);
    declare(readers[i], context, scene.objects[i].name);
  }
  for (std::size_t i = 0; i < readers.size(); ++i) {
    read_object(readers[i], context, scene, scene.objects[i]);
  }
}

void read_relocations(MapReader& root, SceneContext& context, SceneDescription& scene) {
  for (const ListItem& item : root.list("relocations")) {
    MapReader reader(item.node, item.path, context.problems);
    RelocationDescription relocation;
    const bool complete = reader.require({"object", "at_s", "to_m"});
    reader.read("object", relocation.object);
    reader.read("at_s", relocation.at_s, kSeconds);
    reader.read("to_m", relocation.to.position_m);
    reader.read_scaled("yaw_deg", relocation.to.yaw_rad, kDegrees, kRadians);
    reader.finish();
    if (!complete) continue;
    context.names.use_object(relocation.object, reader.line("object"), reader.path("object"));
    if (!is_in_a_room(scene, relocation.to.position_m, kBeyondWall)) {
      reader.add_problem("to_m", "is outside all rooms");
    }
    scene.relocations.push_back(std::move(relocation));
  }
}

void read_moves(MapReader& root, SceneContext& context, SceneDescription& scene) {
  for (const ListItem& item : root.list("moves")) {
    MapReader reader(item.node, item.path, context.problems);
    MoveDescription move;
    const bool complete = reader.require({"object", "from_s", "to_s"});
    read_move(reader, move);
    if (!complete) continue;
    context.names.use_object(move.object, reader.line("object"), reader.path("object"));
    check_move(reader, scene, move);
    scene.moves.push_back(std::move(move));
  }
}

}  // namespace tsg
