#include "common/simulation/people/actor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/check.hpp"
#include "common/simulation/people/easing.hpp"

namespace tsg::simulation {
namespace {

constexpr double kRepeatsFor_s = 3600.0;
constexpr double kForEver_s = 1e9;
constexpr double kSitDown_s = 1.5;
constexpr double kStandUp_s = 1.4;
constexpr double kPutHandsOn_s = 0.7;
constexpr double kReach_s = 0.9;
constexpr double kHandSpeed = 0.36;       // m/s, mean, of hands that lift or put down
constexpr double kWalkSpeed = 1.1;        // m/s, where no action says one
constexpr double kTurnSpeed = 0.65;       // m/s of the feet
constexpr double kTurnFirst_rad = 1.0;    // bigger turns are made before walking off
constexpr double kSharpCorner_rad = 2.1;  // walked to, turned at, walked on from
constexpr double kSitsAlready_m = 0.5;
constexpr double kPushingReach_m = 0.43;  // from the feet to the hands of one who pushes
constexpr double kPutDownAhead_m = 0.5;

double yaw_between(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d way = to - from;
  return std::atan2(way.y(), way.x());
}

/// Leaves out corners that are nearer than 2 cm to the one before.
std::vector<Eigen::Vector2d> without_repeats(const std::vector<Eigen::Vector2d>& corners) {
  std::vector<Eigen::Vector2d> result;
  for (const Eigen::Vector2d& corner : corners) {
    if (result.empty() || (corner - result.back()).norm() > 0.02) result.push_back(corner);
  }
  return result;
}

/// Cuts a polyline where it turns too sharply to be rounded; parts share their end points.
std::vector<std::vector<Eigen::Vector2d>> split_at_sharp_corners(
    const std::vector<Eigen::Vector2d>& corners) {
  std::vector<std::vector<Eigen::Vector2d>> parts(1);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    parts.back().push_back(corners[i]);
    if (i == 0 || i + 1 == corners.size()) continue;
    const double turn =
        wrapped(yaw_between(corners[i], corners[i + 1]) - yaw_between(corners[i - 1], corners[i]));
    if (std::abs(turn) > kSharpCorner_rad) parts.push_back({corners[i]});
  }
  return parts;
}

}  // namespace

Actor::Actor(const Role& role, PropStage& stage)
    : role_(role), stage_(stage), timeline_(role.skeleton, role.seed), here_(role.person.start) {
  is_done_ = role_.person.actions.empty();
  start_seated();
  stay(std::max(role_.person.begin_s, 1e-3), Gesture::kIdle, 1e-3);
  round_begin_s_ = now_s_;
}

void Actor::start_seated() {
  if (is_done_ || role_.person.actions.front().kind != ActionKind::kSit) return;
  const std::size_t index = stage_.index_of(role_.person.actions.front().object);
  PlannedProp& prop = stage_.at(index);
  const Eigen::Vector3d seat = prop.T_world_now * prop.prop.seat->centre_m;
  if ((seat.head<2>() - here_.position_m).norm() > kSitsAlready_m) return;
  if (prop.free_at_s > 0.0) return;
  here_ = place_before_seat(prop);
  seat_ = index;
  sitting_ = sitting_on(prop);
  prop.free_at_s = PlannedProp::kInUse;
  prop.used_by = role_.number;
}

std::optional<std::size_t> Actor::blocking_prop() const {
  const ActionDescription& action = role_.person.actions.at(next_action_);
  for (const std::string& name : {action.object, action.carry}) {
    if (name.empty()) continue;
    const std::size_t index = stage_.index_of(name);
    const PlannedProp& prop = stage_.at(index);
    const bool is_mine = prop.free_at_s == PlannedProp::kInUse && prop.used_by == role_.number;
    if (!is_mine && prop.free_at_s > now_s_) return index;
  }
  return std::nullopt;
}

void Actor::wait_until(double time_s) {
  if (time_s > now_s_) stay(time_s - now_s_, Gesture::kIdle, 0.45);
}

void Actor::plan_next_action() {
  const ActionDescription action = role_.person.actions.at(next_action_);
  const auto uses = [this](const std::string& name) {
    return !name.empty() && held_ && held_->prop == stage_.index_of(name);
  };
  if (held_ && !uses(action.carry)) put_down();
  const bool stays_seated = action.kind == ActionKind::kPause || action.kind == ActionKind::kSit;
  if (seat_ && !stays_seated) stand_up();
  if (!action.carry.empty() && !held_) take(action.carry);
  switch (action.kind) {
    case ActionKind::kWalk: {
      std::vector<Eigen::Vector2d> corners{here_.position_m};
      corners.insert(corners.end(), action.path_m.begin(), action.path_m.end());
      walk_along(corners, action.speed_mps);
      break;
    }
    case ActionKind::kSit:
      sit(action);
      break;
    case ActionKind::kStand:
      if (action.has_yaw) turn_to(action.yaw_rad, 0.0);
      stay(action.duration_s, *gesture_called(action.gesture), 0.6);
      break;
    case ActionKind::kPush:
      push(action);
      break;
    case ActionKind::kPause:
      stay(action.duration_s, Gesture::kIdle, 0.6);
      break;
  }
  const bool is_last = next_action_ + 1 == role_.person.actions.size();
  if (held_ && (is_last || role_.person.actions[next_action_ + 1].carry != action.carry))
    put_down();
  ++next_action_;
  if (is_last) finish_round();
}

void Actor::finish_round() {
  const bool goes_on = role_.person.repeat && now_s_ < kRepeatsFor_s && now_s_ > round_begin_s_;
  if (!goes_on) {
    is_done_ = true;
    return;
  }
  next_action_ = 0;
  const bool sits_again = seat_ && role_.person.actions.front().kind == ActionKind::kSit &&
                          stage_.index_of(role_.person.actions.front().object) == *seat_;
  if (!sits_again) {
    const PlannedProp* const chair = seat_ ? &stage_.at(*seat_) : nullptr;
    if (seat_) stand_up();
    walk_to(role_.person.start, kWalkSpeed, chair);
    turn_to(role_.person.start.yaw_rad, 0.0);
  }
  round_begin_s_ = now_s_;
}

Timeline Actor::take_timeline() {
  stay(kForEver_s, Gesture::kIdle, 0.6);
  return std::move(timeline_);
}

Sitting Actor::sitting_on(const PlannedProp& prop) const {
  const Eigen::Vector3d seat = prop.T_world_now * prop.prop.seat->centre_m;
  Sitting sitting;
  sitting.back_m = 0.94 * role_.skeleton.thigh_m;
  sitting.hips_z_m = seat.z() + hips_above_seat_m(role_.skeleton);
  return sitting;
}

FloorPose Actor::place_before_seat(const PlannedProp& prop) const {
  const Eigen::Vector3d seat = prop.T_world_now * prop.prop.seat->centre_m;
  const double yaw = prop.floor_pose().yaw_rad;
  // The hips come to rest a little behind the middle of the cushion.
  return {moved_by({seat.head<2>(), yaw}, {0.94 * role_.skeleton.thigh_m - 0.05, 0.0}), yaw};
}

void Actor::sit(const ActionDescription& action) {
  const std::size_t index = stage_.index_of(action.object);
  if (seat_ && *seat_ != index) stand_up();
  const Gesture gesture = *gesture_called(action.gesture);
  if (!seat_) {
    PlannedProp& prop = stage_.at(index);
    const FloorPose place = place_before_seat(prop);
    walk_to(place, kWalkSpeed, &prop);
    move(Route(here_, place, 0.0), kTurnSpeed, false);
    prop.free_at_s = PlannedProp::kInUse;
    prop.used_by = role_.number;
    seat_ = index;
    sitting_ = sitting_on(prop);
    Segment down;
    down.sitting = sitting_;
    append(down, kSitDown_s);
  }
  stay(action.duration_s, gesture, 0.6);
}

void Actor::stand_up() {
  Segment up;
  up.sitting = sitting_;
  std::swap(up.sitting->from, up.sitting->to);
  append(up, kStandUp_s);
  stage_.at(*seat_).free_at_s = now_s_;
  seat_.reset();
  sitting_.reset();
}

double Actor::facing_to_push(const PlannedProp& prop, const ActionDescription& action) const {
  const FloorPose pose = prop.floor_pose();
  if (prop.prop.seat) return pose.yaw_rad;  // a chair has its back behind
  const double wanted =
      yaw_between(pose.position_m, action.path_m.front()) + (action.pull ? kPi : 0.0);
  return pose.yaw_rad + 0.5 * kPi * std::round(wrapped(wanted - pose.yaw_rad) / (0.5 * kPi));
}

void Actor::push(const ActionDescription& action) {
  const std::size_t index = stage_.index_of(action.object);
  PlannedProp& prop = stage_.at(index);
  const FloorPose start = prop.floor_pose();
  const double facing = facing_to_push(prop, action);
  const double half_depth = prop.half_extent_m(facing);
  const double gap = half_depth + kPushingReach_m * role_.skeleton.scale;
  const FloorPose behind{moved_by({start.position_m, facing}, {-gap, 0.0}), facing};
  walk_to(behind, kWalkSpeed, &prop);
  move(Route(here_, behind, 0.0), kTurnSpeed, false);
  Held held;
  held.prop = index;
  held.moves = false;
  held.from_m = held.to_m = {gap, 0.0, prop.base_z_m()};
  held.yaw_rad = start.yaw_rad - facing;
  held.grip_back_m = 0.85 * half_depth;
  held.grip_height_m = prop.prop.grip_height_m;
  held.half_width_m =
      std::clamp(0.75 * prop.half_extent_m(facing + 0.5 * kPi), 0.08, 0.24 * role_.skeleton.scale);
  held.palm_rad = 1.1;
  held_ = held;
  stay(kPutHandsOn_s, Gesture::kIdle, kPutHandsOn_s);
  held_->moves = true;
  std::vector<Eigen::Vector2d> corners{start.position_m};
  corners.insert(corners.end(), action.path_m.begin(), action.path_m.end());
  push_along(without_repeats(corners), action, gap);
  held_.reset();
  prop.free_at_s = now_s_;
}

void Actor::push_along(const std::vector<Eigen::Vector2d>& corners,
                       const ActionDescription& action,
                       double gap_m) {
  if (corners.size() < 2) return;
  for (const std::vector<Eigen::Vector2d>& part : split_at_sharp_corners(corners)) {
    const RoundedPath path(part);
    const double yaw = path.heading_rad(0.0) + (action.pull ? kPi : 0.0);
    if (std::abs(wrapped(yaw - here_.yaw_rad)) > kTurnFirst_rad) turn_to(yaw, gap_m);
    move(Route(path, {here_.yaw_rad, action.pull, gap_m}), action.speed_mps, !action.pull);
  }
}

void Actor::take(const std::string& name) {
  const std::size_t index = stage_.index_of(name);
  PlannedProp& prop = stage_.at(index);
  const FloorPose thing = prop.floor_pose();
  const double yaw = yaw_between(here_.position_m, thing.position_m);
  const double half_depth = prop.half_extent_m(yaw);
  const double distance = half_depth + (prop.base_z_m() > 0.4 ? 0.48 : 0.36) * role_.skeleton.scale;
  const FloorPose before{moved_by({thing.position_m, yaw}, {-distance, 0.0}), yaw};
  walk_to(before, kWalkSpeed, nullptr);
  move(Route(here_, before, 0.0), kTurnSpeed, false);
  prop.free_at_s = PlannedProp::kInUse;
  prop.used_by = role_.number;
  Held held;
  held.prop = index;
  held.moves = false;
  held.from_m = held.to_m = {distance, 0.0, prop.base_z_m()};
  held.yaw_rad = thing.yaw_rad - yaw;
  held.grip_height_m = 0.07;
  held.half_width_m = std::min(prop.half_extent_m(yaw + 0.5 * kPi) + 0.025, 0.4);
  held_ = held;
  stay(kReach_s, Gesture::kIdle, kReach_s);
  held_->moves = true;
  held_->to_m = {0.22 * role_.skeleton.scale + half_depth, 0.0, 0.98 * role_.skeleton.scale};
  stay(std::max(0.8, (held_->to_m - held_->from_m).norm() / kHandSpeed), Gesture::kIdle, 0.01);
  held_->from_m = held_->to_m;
}

void Actor::put_down() {
  PlannedProp& prop = stage_.at(held_->prop);
  const double half_depth = held_->to_m.x() - 0.22 * role_.skeleton.scale;
  const double ahead = std::max(kPutDownAhead_m, half_depth + 0.3 * role_.skeleton.scale);
  held_->to_m = {ahead, 0.0, stage_.support_z_m(moved_by(here_, {ahead, 0.0}), held_->prop)};
  stay(std::max(0.8, (held_->to_m - held_->from_m).norm() / kHandSpeed), Gesture::kIdle, 0.01);
  held_.reset();
  prop.free_at_s = now_s_;
  stay(kReach_s, Gesture::kIdle, kReach_s);
}

void Actor::walk_to(const FloorPose& place, double speed_mps, const PlannedProp* obstacle) {
  constexpr double kSteps_m = 0.35;  // nearer places are reached by a step or two, while turning
  if ((place.position_m - here_.position_m).norm() < kSteps_m) {
    move(Route(here_, place, 0.0), kTurnSpeed, false);
    return;
  }
  std::vector<Eigen::Vector2d> corners{here_.position_m};
  if (obstacle != nullptr) {
    const auto way = way_around(*obstacle, here_.position_m, place.position_m);
    corners.insert(corners.end(), way.begin(), way.end());
  }
  corners.push_back(place.position_m);
  walk_along(corners, speed_mps);
}

void Actor::walk_along(std::vector<Eigen::Vector2d> corners, double speed_mps) {
  corners = without_repeats(corners);
  if (corners.size() < 2) return;
  for (const std::vector<Eigen::Vector2d>& part : split_at_sharp_corners(corners)) {
    const RoundedPath path(part);
    const double yaw = path.heading_rad(0.0);
    if (std::abs(wrapped(yaw - here_.yaw_rad)) > kTurnFirst_rad) turn_to(yaw, 0.0);
    move(Route(path, {here_.yaw_rad, false, 0.0}), speed_mps, true);
  }
}

void Actor::turn_to(double yaw_rad, double gap_m) {
  const FloorPose from{moved_by(here_, {gap_m, 0.0}), here_.yaw_rad};
  move(Route(from, {from.position_m, yaw_rad}, gap_m), kTurnSpeed, false);
}

void Actor::move(const Route& route, double speed_mps, bool rolls) {
  if (route.length_m() < 0.01) return;
  const SpeedProfile profile(route.length_m(), speed_mps);
  Segment segment;
  segment.motion = Motion{route, profile, Gait(role_.skeleton, route, speed_mps, rolls)};
  append(segment, profile.duration_s());
  here_ = route.person_at(route.length_m());
}

void Actor::stay(double duration_s, Gesture gesture, double fade_s) {
  Segment segment;
  segment.gesture = gesture;
  segment.fade_s = fade_s;
  segment.sitting = sitting_;
  if (sitting_) segment.sitting->from = sitting_->to;
  append(segment, duration_s);
}

void Actor::append(Segment segment, double duration_s) {
  if (duration_s <= 0.0) return;
  segment.begin_s = now_s_;
  segment.end_s = now_s_ + duration_s;
  segment.fade_s = std::min(segment.fade_s, duration_s);
  segment.place = here_;
  segment.held = held_;
  const std::size_t number = timeline_.add(segment);
  now_s_ = segment.end_s;
  if (!held_ || !held_->moves) return;
  PlannedProp& prop = stage_.at(held_->prop);
  prop.moves.push_back({segment.begin_s, segment.end_s, role_.number, number});
  prop.T_world_now = timeline_.T_world_held(number, segment.end_s);
}

}  // namespace tsg::simulation
