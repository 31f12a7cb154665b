#include "common/simulation/people/actor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/check.hpp"
#include "common/simulation/people/easing.hpp"

namespace tsg::simulation {
namespace {

constexpr double kRepeatsForS = 3600.0;
constexpr double kForEverS = 1e9;
constexpr double kSitDownS = 1.5;
constexpr double kStandUpS = 1.4;
constexpr double kWalkSpeed = 1.1;     // m/s, where no action says one
constexpr double kTurnSpeed = 0.65;    // m/s of the feet
constexpr double kTurnFirstRad = 1.0;  // bigger turns are made before walking off
constexpr double kSitsAlreadyM = 0.5;

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
  if ((seat.head<2>() - here_.position_m).norm() > kSitsAlreadyM) return;
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
      follow(corners, {action.speed_mps, false, 0.0});
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
  const bool goes_on = role_.person.repeat && now_s_ < kRepeatsForS && now_s_ > round_begin_s_;
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
    go_to(role_.person.start, chair);
  }
  round_begin_s_ = now_s_;
}

Timeline Actor::take_timeline() {
  stay(kForEverS, Gesture::kIdle, 0.6);
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
    go_to(place, &prop);
    prop.free_at_s = PlannedProp::kInUse;
    prop.used_by = role_.number;
    seat_ = index;
    sitting_ = sitting_on(prop);
    Segment down;
    down.sitting = sitting_;
    append(down, kSitDownS);
  }
  stay(action.duration_s, gesture, 0.6);
}

void Actor::stand_up() {
  Segment up;
  up.sitting = sitting_;
  std::swap(up.sitting->from, up.sitting->to);
  append(up, kStandUpS);
  stage_.at(*seat_).free_at_s = now_s_;
  seat_.reset();
  sitting_.reset();
}

void Actor::go_to(const FloorPose& place, const PlannedProp* obstacle) {
  constexpr double kStepsM = 0.35;  // nearer places are reached by a step or two, while turning
  if ((place.position_m - here_.position_m).norm() >= kStepsM) {
    std::vector<Eigen::Vector2d> corners{here_.position_m};
    if (obstacle != nullptr) {
      const auto way = way_around(*obstacle, here_.position_m, place.position_m);
      corners.insert(corners.end(), way.begin(), way.end());
    }
    corners.push_back(place.position_m);
    follow(corners, {kWalkSpeed, false, 0.0});
  }
  move(Route(here_, place, 0.0), kTurnSpeed, false);
}

void Actor::follow(const std::vector<Eigen::Vector2d>& corners, const Walk& walk) {
  for (const std::vector<Eigen::Vector2d>& part : walkable_parts(corners)) {
    const RoundedPath path(part);
    const double yaw = path.heading_rad(0.0) + (walk.backwards ? kPi : 0.0);
    if (std::abs(wrapped(yaw - here_.yaw_rad)) > kTurnFirstRad) turn_to(yaw, walk.trailing_m);
    move(Route(path, {here_.yaw_rad, walk.backwards, walk.trailing_m}), walk.speed_mps,
         !walk.backwards);
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
