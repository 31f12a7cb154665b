// Sections objects and relocations.
#include <numbers>

#include "common/scene_file/scene_sections.hpp"

namespace tsg {
namespace {

using simulation::ObjectDescription;
using simulation::RelocationDescription;
using simulation::SceneDescription;

constexpr double kRadians = std::numbers::pi / 180.0;
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

}  // namespace tsg
