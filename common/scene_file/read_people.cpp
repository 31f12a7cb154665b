// Section people, with what they do.

#include "common/scene_file/scene_sections.hpp"

namespace tsg {
namespace {

using simulation::ActionDescription;
using simulation::ActionKind;
using simulation::PersonDescription;
using simulation::SceneDescription;

constexpr Limits kSpeed{0.1, 2.5};
constexpr Limits kDuration{0.1, 86'400.0};
constexpr double kPushSpeed = 0.6;  // m/s; furniture slows one down

const std::vector<std::string> kActions{"walk", "sit", "stand", "push", "pull", "pause"};
const std::vector<std::string> kGestures{"talk", "wave", "point", "type", "phone", "idle"};

/// Reads the actions of one person.
class ActionReader {
 public:
  ActionReader(SceneContext& context, const SceneDescription& scene)
      : context_(context), scene_(scene) {}

  std::optional<ActionDescription> read(const ListItem& item) {
    MapReader reader(item.node, item.path, context_.problems);
    auto only = reader.only_map(kActions);
    if (!only) return {};
    const std::string& kind = only->first;
    MapReader& arguments = only->second;
    ActionDescription action;
    if (kind == "walk") {
      read_walk(arguments, action);
    } else if (kind == "sit") {
      read_sit(arguments, action);
    } else if (kind == "stand") {
      read_stand(arguments, action);
    } else if (kind == "pause") {
      action.kind = ActionKind::kPause;
      read_duration(arguments, action);
    } else {
      read_push(arguments, action);
      action.pull = kind == "pull";
    }
    arguments.finish();
    return action;
  }

 private:
  void read_walk(MapReader& reader, ActionDescription& action) {
    action.kind = ActionKind::kWalk;
    read_path(reader, action);
    read_object(reader, "carry", action.carry);
  }

  void read_sit(MapReader& reader, ActionDescription& action) {
    action.kind = ActionKind::kSit;
    reader.require({"on"});
    read_object(reader, "on", action.object);
    read_duration(reader, action);
    reader.read("gesture", action.gesture, kGestures);
  }

  void read_stand(MapReader& reader, ActionDescription& action) {
    action.kind = ActionKind::kStand;
    read_duration(reader, action);
    reader.read("gesture", action.gesture, kGestures);
    read_object(reader, "carry", action.carry);
    action.has_yaw = reader.has("yaw_deg");
    reader.read_scaled("yaw_deg", action.yaw_rad, kDegrees, kRadians);
  }

  void read_push(MapReader& reader, ActionDescription& action) {
    action.kind = ActionKind::kPush;
    action.speed_mps = kPushSpeed;
    reader.require({"object"});
    read_object(reader, "object", action.object);
    read_path(reader, action);
  }

  static void read_duration(MapReader& reader, ActionDescription& action) {
    reader.require({"for_s"});
    reader.read("for_s", action.duration_s, kDuration);
  }

  void read_path(MapReader& reader, ActionDescription& action) {
    const std::vector<ListItem> corners = reader.list("path_m");
    if (corners.empty() && reader.require({"path_m"}) && reader.is_list("path_m")) {
      reader.add_problem("path_m", "must have at least one corner, e.g. [[1.0, 2.0]]");
    }
    for (const ListItem& item : corners) {
      const auto numbers = read_numbers(item, 2, kMetres, context_.problems);
      if (!numbers) continue;
      action.path_m.emplace_back(numbers->at(0), numbers->at(1));
      if (!is_in_a_room(scene_, action.path_m.back(), 0.0)) {
        context_.problems.add(item.line(), item.path, "is outside all rooms");
      }
    }
    reader.read("speed_mps", action.speed_mps, kSpeed);
  }

  void read_object(MapReader& reader, const std::string& key, std::string& name) {
    reader.read(key, name);
    if (!name.empty()) context_.names.use_object(name, reader.line(key), reader.path(key));
  }

  SceneContext& context_;
  const SceneDescription& scene_;
};

void read_start(MapReader& reader, const SceneDescription& scene, PersonDescription& person) {
  if (!reader.require({"start"})) return;
  auto start = reader.map("start");
  if (!start) return;
  const bool complete = start->require({"at_m"});
  start->read("at_m", person.start.position_m);
  start->read_scaled("yaw_deg", person.start.yaw_rad, kDegrees, kRadians);
  start->finish();
  if (complete && !is_in_a_room(scene, person.start.position_m, 0.0)) {
    start->add_problem("at_m", "is outside all rooms");
  }
}

}  // namespace

void read_people(MapReader& root, SceneContext& context, SceneDescription& scene) {
  for (const ListItem& item : root.list("people")) {
    MapReader reader(item.node, item.path, context.problems);
    PersonDescription person;
    person.name = "person_" + std::to_string(scene.people.size() + 1);
    reader.read("name", person.name);
    context.names.declare_person(person.name, reader.line("name"), context.problems);
    reader.read("height_m", person.height_m, {1.0, 2.2});
    reader.read("look", person.look);
    read_start(reader, scene, person);
    reader.read("begin_s", person.begin_s, kSeconds);
    reader.read("repeat", person.repeat);
    ActionReader actions(context, scene);
    for (const ListItem& action : reader.list("actions")) {
      if (auto read = actions.read(action)) person.actions.push_back(std::move(*read));
    }
    reader.finish();
    scene.people.push_back(std::move(person));
  }
}

}  // namespace tsg
