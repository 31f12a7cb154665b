#include "common/simulation/people/check_actions.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "common/simulation/people/gestures.hpp"

namespace tsg::simulation {
namespace {

using Props = std::map<std::string, Prop>;

const char* name_of(ActionKind kind) {
  static constexpr std::array<const char*, 5> kNames{"walk", "sit", "stand", "push", "pause"};
  return kNames.at(static_cast<std::size_t>(kind));
}

bool goes_along_path(ActionKind kind) {
  return kind == ActionKind::kWalk || kind == ActionKind::kPush;
}

std::optional<std::string> problem_of_path(const ActionDescription& action) {
  if (!goes_along_path(action.kind)) return std::nullopt;
  if (action.path_m.empty()) return "has a path without corners; give at least one [x, y]";
  for (const Eigen::Vector2d& corner : action.path_m) {
    if (!corner.allFinite()) return "has a corner that is not a number; give [x, y] in metres";
  }
  if (!(action.speed_mps >= 0.1 && action.speed_mps <= 2.5)) {
    return "has a speed outside 0.1..2.5 m/s, which is not a walk; give one within";
  }
  return std::nullopt;
}

std::optional<std::string> problem_of_objects(const ActionDescription& action, const Props& props) {
  const bool needs_object = action.kind == ActionKind::kSit || action.kind == ActionKind::kPush;
  if (needs_object && action.object.empty()) return "names no object; say which one";
  for (const std::string& name : {action.object, action.carry}) {
    if (!name.empty() && !props.contains(name)) {
      return "uses '" + name + "', which is no object of the scene; name one that is";
    }
  }
  if (action.kind == ActionKind::kSit && !props.at(action.object).seat) {
    return "wants to sit on '" + action.object + "', which has no seat; name a chair or sofa";
  }
  const bool may_carry = action.kind == ActionKind::kWalk || action.kind == ActionKind::kStand;
  if (!may_carry && !action.carry.empty()) {
    return "cannot carry '" + action.carry + "'; only walk and stand leave both hands free for it";
  }
  return std::nullopt;
}

std::optional<std::string> problem_of(const ActionDescription& action, const Props& props) {
  if (!gesture_called(action.gesture)) {
    return "makes the gesture '" + action.gesture +
           "', which nobody knows; use talk, wave, point, type, phone or idle";
  }
  if (!(action.duration_s >= 0.0 && std::isfinite(action.duration_s))) {
    return "has a duration below zero; give seconds";
  }
  if (auto problem = problem_of_path(action)) return problem;
  return problem_of_objects(action, props);
}

std::optional<std::string> problem_of(const PersonDescription& person) {
  if (!(person.height_m >= 1.0 && person.height_m <= 2.3)) {
    return "has a height outside 1.0..2.3 m; give one within";
  }
  if (!(person.begin_s >= 0.0 && std::isfinite(person.begin_s))) {
    return "begins before the first frame; give begin_s of 0 or more";
  }
  if (!person.start.position_m.allFinite() || !std::isfinite(person.start.yaw_rad)) {
    return "starts at a place that is not a number; give a position in metres and a yaw";
  }
  return std::nullopt;
}

}  // namespace

std::string action_label(const PersonDescription& person, std::size_t action) {
  return "person '" + person.name + "', action " + std::to_string(action + 1) + " (" +
         name_of(person.actions.at(action).kind) + ")";
}

namespace {

Expected<void> check_actions_of(const PersonDescription& person, const Props& props) {
  for (std::size_t i = 0; i < person.actions.size(); ++i) {
    if (const auto problem = problem_of(person.actions[i], props)) {
      return make_error(ExitCode::kBadData, action_label(person, i) + " " + *problem);
    }
  }
  return {};
}

}  // namespace

Expected<void> check_actions(const std::vector<PersonDescription>& people, const Props& props) {
  for (const PersonDescription& person : people) {
    if (const auto problem = problem_of(person)) {
      return make_error(ExitCode::kBadData, "person '" + person.name + "' " + *problem);
    }
    if (auto checked = check_actions_of(person, props); !checked) return checked;
  }
  return {};
}

}  // namespace tsg::simulation
