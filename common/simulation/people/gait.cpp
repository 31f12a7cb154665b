#include "common/simulation/people/gait.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/simulation/people/easing.hpp"

namespace tsg::simulation {
namespace {

// Phase counts steps: at phase k the body is above the place where step k is put down. Step k lands
// half a step earlier; both feet are on the floor for a fifth of each step (Winter 1991).
constexpr double kLandsBefore = 0.5;
constexpr double kDoubleSupport = 0.2;
constexpr double kBriskStepM = 0.62;  // of an adult of 1.75 m at kBriskSpeed
constexpr double kBriskSpeed = 1.1;   // m/s
constexpr double kLiftM = 0.055;      // of the sole in mid-swing
constexpr double kHeelStrikeRad = 0.30;
constexpr double kPushOffRad = 0.65;

/// Where a foot of one who stands at `pose` is.
FloorPose foot_place(const Skeleton& skeleton, const FloorPose& pose, Side side) {
  return {moved_by(pose, {0.0, sign_of(side) * half_stance_m(skeleton)}),
          pose.yaw_rad + sign_of(side) * 0.1};
}

}  // namespace

/// A step of one foot: `progress` 0 while it still stands at `from_m`, 1 from its landing on.
struct Gait::Swing {
  double from_m;
  double to_m;
  double progress;
  double since_landing;  ///< phase since it landed at `to_m`; < 0 before
  bool rolls_off;        ///< its heel rose before it left the floor
  bool is_last;
};

Gait::Gait(const Skeleton& skeleton, const Route& route, double speed_mps, bool rolls)
    : rolls_(rolls) {
  const double natural_m = std::clamp(kBriskStepM * std::sqrt(speed_mps / kBriskSpeed), 0.3, 0.8) *
                           (rolls ? 1.0 : 0.75) * skeleton.scale;
  steps_ = std::max(1, static_cast<int>(std::lround(route.length_m() / natural_m)));
  step_m_ = route.length_m() / steps_;
  stride_ = std::min(1.2, step_m_ / kBriskStepM);
  // The foot on the inner side goes first, so that legs do not cross.
  const FloorPose start = route.person_at(0.0);
  const FloorPose next = route.person_at(step_m_);
  const Eigen::Vector2d shift = next.position_m - start.position_m;
  const Eigen::Vector2d left{-std::sin(start.yaw_rad), std::cos(start.yaw_rad)};
  const double leftwards = shift.dot(left) + 0.3 * (next.yaw_rad - start.yaw_rad);
  if (leftwards > 1e-3) first_ = Side::kLeft;
}

Side Gait::side_of_step(int step) const { return step % 2 != 0 ? first_ : other_side(first_); }

double Gait::landing_m(int step) const { return step_m_ * std::clamp(step, 0, steps_); }

/// Swaying begins with the first step and ends with the last one.
double Gait::rhythm(double phase) const {
  return eased(phase / 0.8) * eased((steps_ - phase) / 0.8);
}

Gait::Swing Gait::swing_of(Side side, double phase) const {
  const auto start_of = [](int step) {
    return std::max(0.0, step - 1.0 - kLandsBefore + kDoubleSupport);
  };
  // The last step of this foot that has begun; before it begins the foot is where it started.
  int step = side == first_ ? 1 : 2;
  while (step + 2 <= steps_ + 1 && start_of(step + 2) <= phase) step += 2;
  if (step > steps_ + 1) return {0.0, landing_m(steps_), 1.0, 1.0, false, true};
  const double start = start_of(step);
  const double end = step == steps_ + 1 ? steps_ : step - kLandsBefore;
  return {
      landing_m(step - 2), landing_m(step), std::clamp((phase - start) / (end - start), 0.0, 1.0),
      phase - end,         step > 1,        step == steps_ + 1};
}

FootPosture Gait::foot_at(const Skeleton& skeleton,
                          const Route& route,
                          Side side,
                          double phase) const {
  const Swing swing = swing_of(side, phase);
  const FloorPose from = foot_place(skeleton, route.person_at(swing.from_m), side);
  const FloorPose to = foot_place(skeleton, route.person_at(swing.to_m), side);
  const double share = eased(swing.progress);
  const Eigen::Vector2d sole = mixed_values(from.position_m, to.position_m, share);
  const double yaw = from.yaw_rad + share * wrapped(to.yaw_rad - from.yaw_rad);
  const double arc = std::sin(kPi * swing.progress);
  const double lift = kLiftM * skeleton.scale * (0.4 + 0.6 * stride_) * arc * arc;
  double pitch = 0.0;
  if (rolls_) {
    const double push_off = swing.rolls_off ? -kPushOffRad * stride_ : 0.0;
    const double strike = swing.is_last ? 0.0 : kHeelStrikeRad * stride_;
    // The heel rises while the other foot takes the weight, before this one leaves the floor.
    const double until_start = 1.0 + kDoubleSupport - kLandsBefore;
    const double behind = phase - swing.to_m / step_m_;
    if (swing.progress >= 1.0) {
      const bool leaves_again = !swing.is_last && swing.to_m < landing_m(steps_);
      const double rises = leaves_again ? eased((behind - 0.15) / (until_start - 0.15)) : 0.0;
      pitch = strike * (1.0 - eased(swing.since_landing / 0.25)) - kPushOffRad * stride_ * rises;
    } else if (swing.progress <= 0.0) {
      const double rises = eased((phase - swing.from_m / step_m_ - 0.15) / (until_start - 0.15));
      pitch = push_off * rises;
    } else {
      pitch = mixed_values(push_off, strike, eased(1.15 * swing.progress));
    }
  }
  return make_foot(skeleton, {sole.x(), sole.y(), lift}, yaw, pitch);
}

Posture Gait::at(const Skeleton& skeleton, const Route& route, double along_m) const {
  const double phase = step_m_ > 0.0 ? along_m / step_m_ : 0.0;
  const SE3 T_person_world = to_transform(route.person_at(along_m)).inverse();
  const double yaw = route.person_at(along_m).yaw_rad;
  const double share = rhythm(phase) * stride_;
  const double sign = sign_of(first_);
  const double swing = sign * std::sin(kPi * phase) * share;    // > 0: left foot ahead
  const double weight = -sign * std::cos(kPi * phase) * share;  // > 0: on the left foot
  Posture posture = standing_posture(skeleton);
  for (const Side side : kBothSides) {
    FootPosture& foot = posture.feet.at(index_of(side));
    foot = foot_at(skeleton, route, side, phase);
    foot.ankle_m = T_person_world * foot.ankle_m;
    foot.yaw_rad = wrapped(foot.yaw_rad - yaw);
  }
  posture.pelvis_m.y() += 0.022 * skeleton.scale * weight;
  posture.pelvis_m.z() += skeleton.scale * share * (0.010 * std::cos(2.0 * kPi * phase) - 0.012);
  posture.pelvis_rpy = {0.035 * weight, 0.0, -0.09 * swing};
  posture.spine_rpy = {-0.05 * weight, 0.05 * share, 0.19 * swing};
  posture.head_rpy = {0.0, -0.03 * share, -0.10 * swing};
  settle_pelvis(skeleton, posture);
  for (const Side side : kBothSides) {
    const double forward = -sign_of(side) * swing;
    let_arm_hang(skeleton, side, 0.03 + 0.38 * forward,
                 0.18 + share * (0.20 + 0.22 * std::max(0.0, forward)), posture);
  }
  return posture;
}

}  // namespace tsg::simulation
