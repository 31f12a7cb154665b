#include <algorithm>
#include <cmath>

#include "common/simulation/people/actor.hpp"
#include "common/simulation/people/easing.hpp"

namespace tsg::simulation {
namespace {

constexpr double kPutHandsOnS = 0.7;
constexpr double kReachS = 0.9;
constexpr double kHandSpeed = 0.36;      // m/s, mean, of hands that lift or put down
constexpr double kPushingReachM = 0.43;  // from the feet to the hands of one who pushes
constexpr double kPutDownAheadM = 0.5;

/// Where one looks who pushes or pulls `prop` along the path of `action`.
double facing_to_push(const PlannedProp& prop, const ActionDescription& action) {
  const FloorPose pose = prop.floor_pose();
  if (prop.prop.seat) return pose.yaw_rad;  // a chair has its back behind
  const double wanted =
      heading_between(pose.position_m, action.path_m.front()) + (action.pull ? kPi : 0.0);
  return pose.yaw_rad + 0.5 * kPi * std::round(wrapped(wanted - pose.yaw_rad) / (0.5 * kPi));
}

}  // namespace

Held Actor::grip_to_push(std::size_t index, double gap_m) const {
  const PlannedProp& prop = stage_.at(index);
  Held held;
  held.prop = index;
  held.moves = false;
  held.from_m = held.to_m = {gap_m, 0.0, prop.base_z_m()};
  held.yaw_rad = prop.floor_pose().yaw_rad - here_.yaw_rad;
  held.grip_back_m = 0.85 * prop.half_extent_m(here_.yaw_rad);
  held.grip_height_m = prop.prop.grip_height_m;
  held.half_width_m = std::clamp(0.75 * prop.half_extent_m(here_.yaw_rad + 0.5 * kPi), 0.08,
                                 0.24 * role_.skeleton.scale);
  held.palm_rad = 1.1;
  return held;
}

void Actor::push(const ActionDescription& action) {
  const std::size_t index = stage_.index_of(action.object);
  PlannedProp& prop = stage_.at(index);
  const FloorPose start = prop.floor_pose();
  const double facing = facing_to_push(prop, action);
  const double gap = prop.half_extent_m(facing) + kPushingReachM * role_.skeleton.scale;
  const FloorPose behind{moved_by({start.position_m, facing}, {-gap, 0.0}), facing};
  go_to(behind, &prop);
  held_ = grip_to_push(index, gap);
  stay(kPutHandsOnS, Gesture::kIdle, kPutHandsOnS);
  held_->moves = true;
  std::vector<Eigen::Vector2d> corners{start.position_m};
  corners.insert(corners.end(), action.path_m.begin(), action.path_m.end());
  follow(corners, {action.speed_mps, action.pull, gap});
  held_.reset();
  prop.free_at_s = now_s_;
}

void Actor::take(const std::string& name) {
  const std::size_t index = stage_.index_of(name);
  PlannedProp& prop = stage_.at(index);
  const FloorPose thing = prop.floor_pose();
  const double yaw = heading_between(here_.position_m, thing.position_m);
  const double half_depth = prop.half_extent_m(yaw);
  const double distance = half_depth + (prop.base_z_m() > 0.4 ? 0.48 : 0.36) * role_.skeleton.scale;
  const FloorPose before{moved_by({thing.position_m, yaw}, {-distance, 0.0}), yaw};
  go_to(before, nullptr);
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
  stay(kReachS, Gesture::kIdle, kReachS);
  held_->moves = true;
  held_->to_m = {0.22 * role_.skeleton.scale + half_depth, 0.0, 0.98 * role_.skeleton.scale};
  stay(std::max(0.8, (held_->to_m - held_->from_m).norm() / kHandSpeed), Gesture::kIdle, 0.01);
  held_->from_m = held_->to_m;
}

void Actor::put_down() {
  PlannedProp& prop = stage_.at(held_->prop);
  const double half_depth = held_->to_m.x() - 0.22 * role_.skeleton.scale;
  const double ahead = std::max(kPutDownAheadM, half_depth + 0.3 * role_.skeleton.scale);
  held_->to_m = {ahead, 0.0, stage_.support_z_m(moved_by(here_, {ahead, 0.0}), held_->prop)};
  stay(std::max(0.8, (held_->to_m - held_->from_m).norm() / kHandSpeed), Gesture::kIdle, 0.01);
  held_.reset();
  prop.free_at_s = now_s_;
  stay(kReachS, Gesture::kIdle, kReachS);
}

}  // namespace tsg::simulation
