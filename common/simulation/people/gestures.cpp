#include "common/simulation/people/gestures.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <utility>

#include "common/simulation/people/easing.hpp"
#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

/// A number of -1..1 that belongs to `index` alone.
double chance_value(std::uint64_t seed, std::int64_t index) {
  return Random(mixed(seed ^ mixed(static_cast<std::uint64_t>(index)))).uniform(-1.0, 1.0);
}

/// Goes from one chance value to the next within `change_s` and rests there until `period_s` is
/// over: what a head does that looks here and there.
double glance(std::uint64_t seed, double time_s, double period_s, double change_s) {
  const double count = std::floor(time_s / period_s);
  const auto index = static_cast<std::int64_t>(count);
  const double share = eased((time_s - count * period_s) / change_s);
  return mixed_values(chance_value(seed, index), chance_value(seed, index + 1), share);
}

/// Slow smooth chance of -1..1.
double drift(std::uint64_t seed, double time_s, double period_s) {
  return glance(seed, time_s, period_s, period_s);
}

double phase_of(std::uint64_t seed) { return kPi * chance_value(seed, 7); }

/// Puts a hand at `at_m`, which is relative to the chest joint in axes that turn with the body's
/// yaw only: x ahead, y outwards to the hand's own side, z up.
struct HandPlace {
  Eigen::Vector3d at_m;
  double palm_rad;
};

void place_hand(const Skeleton& skeleton, Side side, const HandPlace& hand, Posture& posture) {
  const SE3 T_person_chest = chest_of(skeleton, posture);
  const double yaw = posture.pelvis_rpy.z() + posture.spine_rpy.z();
  const Eigen::Vector3d offset{hand.at_m.x(), sign_of(side) * hand.at_m.y(), hand.at_m.z()};
  const std::size_t i = index_of(side);
  posture.wrists_m.at(i) =
      T_person_chest.translation() +
      skeleton.scale * (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * offset);
  posture.elbows_towards.at(i) = {-0.55, sign_of(side) * 0.55, -0.8};
  posture.palms_rad.at(i) = hand.palm_rad;
}

/// On the thigh of one who sits, hanging down of one who stands.
void rest_hand(const Skeleton& skeleton, Side side, const GestureMoment& moment, Posture& posture) {
  if (!moment.is_seated) {
    const double sway = 0.03 * drift(moment.seed + index_of(side), moment.time_s, 3.1);
    let_arm_hang(skeleton, side, 0.03 + sway, 0.18 + sway, posture);
    return;
  }
  const std::size_t i = index_of(side);
  posture.wrists_m.at(i) =
      posture.pelvis_m + skeleton.scale * Eigen::Vector3d(0.22, sign_of(side) * 0.135, 0.075);
  posture.elbows_towards.at(i) = {-0.8, sign_of(side) * 0.6, -0.3};
  posture.palms_rad.at(i) = 1.3;
}

void talk(const Skeleton& skeleton, const GestureMoment& moment, Posture& posture) {
  for (const Side side : kBothSides) {
    const std::uint64_t seed = mixed(moment.seed + 11 + index_of(side));
    const double beat = std::sin(2.0 * kPi * 0.9 * moment.time_s + phase_of(seed));
    const double up = drift(seed, moment.time_s, 0.9);
    const double out = drift(seed + 1, moment.time_s, 1.3);
    const double height = moment.is_seated ? -0.04 : -0.06;
    place_hand(
        skeleton, side,
        {{0.30 + 0.04 * out, 0.17 + 0.07 * out, height + 0.09 * up + 0.02 * beat}, 0.1 - 0.7 * up},
        posture);
  }
  posture.head_rpy.y() += 0.06 * drift(moment.seed + 3, moment.time_s, 0.6);
  posture.head_rpy.z() += 0.15 * drift(moment.seed + 4, moment.time_s, 1.1);
}

void wave(const Skeleton& skeleton, const GestureMoment& moment, Posture& posture) {
  rest_hand(skeleton, Side::kLeft, moment, posture);
  const double swing = std::sin(2.0 * kPi * 1.5 * moment.time_s + phase_of(moment.seed));
  place_hand(skeleton, Side::kRight, {{0.16, 0.42 + 0.10 * swing, 0.40 - 0.03 * swing}, 0.9},
             posture);
  posture.elbows_towards[index_of(Side::kRight)] = {-0.4, -0.5, -0.9};
}

void point_out(const Skeleton& skeleton, const GestureMoment& moment, Posture& posture) {
  rest_hand(skeleton, Side::kLeft, moment, posture);
  const double aside = drift(moment.seed + 5, moment.time_s, 2.4);
  place_hand(skeleton, Side::kRight, {{0.52, 0.24 + 0.14 * aside, 0.24 + 0.05 * aside}, 0.9},
             posture);
  posture.spine_rpy.z() -= 0.12 + 0.08 * aside;
  posture.head_rpy.z() -= 0.1 + 0.15 * aside;
}

void type(const Skeleton& skeleton, const GestureMoment& moment, Posture& posture) {
  const double ahead = moment.is_seated ? 0.36 : 0.33;
  const double height = moment.is_seated ? -0.07 : -0.12;
  for (const Side side : kBothSides) {
    const std::uint64_t seed = mixed(moment.seed + 21 + index_of(side));
    const double tap = 0.008 * std::sin(2.0 * kPi * 2.7 * moment.time_s + phase_of(seed));
    const double along = 0.03 * glance(seed, moment.time_s, 0.8, 0.25);
    place_hand(skeleton, side, {{ahead, 0.11 + along, height + tap}, 1.35}, posture);
  }
  posture.head_rpy.y() += 0.22;
}

void phone(const Skeleton& skeleton, const GestureMoment& moment, Posture& posture) {
  rest_hand(skeleton, Side::kLeft, moment, posture);
  posture.head_rpy += Eigen::Vector3d(0.10, 0.05, 0.05);
  place_hand(skeleton, Side::kRight, {{0.06, 0.17, 0.29}, 0.3}, posture);
  posture.elbows_towards[index_of(Side::kRight)] = {0.3, -0.7, -0.8};
}

}  // namespace

std::optional<Gesture> gesture_called(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Gesture>, 7> kNames{
      {{"", Gesture::kIdle},
       {"idle", Gesture::kIdle},
       {"talk", Gesture::kTalk},
       {"wave", Gesture::kWave},
       {"point", Gesture::kPoint},
       {"type", Gesture::kType},
       {"phone", Gesture::kPhone}}};
  for (const auto& [word, gesture] : kNames) {
    if (word == name) return gesture;
  }
  return std::nullopt;
}

void add_idle_motion(const GestureMoment& moment, Posture& posture) {
  const double breath = std::sin(2.0 * kPi * 0.25 * moment.time_s + phase_of(moment.seed));
  const double sway = drift(moment.seed + 1, moment.time_s, 3.7);
  posture.spine_rpy.y() += 0.012 * breath;
  posture.spine_rpy.z() += 0.06 * drift(moment.seed + 2, moment.time_s, 4.3);
  if (!moment.is_seated) {
    posture.pelvis_m.y() += 0.016 * sway;
    posture.pelvis_rpy.x() += 0.02 * sway;
    posture.spine_rpy.x() -= 0.03 * sway;
  }
  add_glances(moment, 1.0, posture);
}

void add_glances(const GestureMoment& moment, double amount, Posture& posture) {
  posture.head_rpy.z() += 0.5 * amount * glance(moment.seed + 31, moment.time_s, 2.6, 0.7);
  posture.head_rpy.y() += 0.1 * amount * glance(moment.seed + 32, moment.time_s, 3.3, 0.8);
}

void add_gesture(const Skeleton& skeleton,
                 Gesture gesture,
                 const GestureMoment& moment,
                 Posture& posture) {
  switch (gesture) {
    case Gesture::kIdle:
      for (const Side side : kBothSides) rest_hand(skeleton, side, moment, posture);
      return;
    case Gesture::kTalk:
      return talk(skeleton, moment, posture);
    case Gesture::kWave:
      return wave(skeleton, moment, posture);
    case Gesture::kPoint:
      return point_out(skeleton, moment, posture);
    case Gesture::kType:
      return type(skeleton, moment, posture);
    case Gesture::kPhone:
      return phone(skeleton, moment, posture);
  }
}

}  // namespace tsg::simulation
