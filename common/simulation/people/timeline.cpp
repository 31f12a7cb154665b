#include "common/simulation/people/timeline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/simulation/people/easing.hpp"

namespace tsg::simulation {
namespace {

constexpr double kLowestUprightM = 0.85;  // hands below this: one bends and squats
constexpr double kEasyReachM = 0.48;      // from the chest's joint; beyond this one leans forward

double progress_of(const Segment& segment, double time_s) {
  const double duration = segment.end_s - segment.begin_s;
  return duration > 0.0 ? (time_s - segment.begin_s) / duration : 1.0;
}

Eigen::Vector3d held_at(const Segment& segment, double time_s) {
  return mixed_values(segment.held->from_m, segment.held->to_m,
                      eased(progress_of(segment, time_s)));
}

/// Both hands to the sides of a thing whose base is at `base_m`; the trunk goes along.
void reach_for(const Skeleton& skeleton,
               const Held& held,
               const Eigen::Vector3d& base_m,
               Posture& posture) {
  const Eigen::Vector3d grip = base_m + Eigen::Vector3d(-held.grip_back_m, 0, held.grip_height_m);
  const double low =
      std::clamp((kLowestUprightM * skeleton.scale - grip.z()) / (0.75 * skeleton.scale), 0.0, 1.0);
  posture.pelvis_m += skeleton.scale * low * Eigen::Vector3d(-0.14, 0.0, -0.38);
  posture.pelvis_rpy.y() += 0.45 * low;
  posture.spine_rpy.y() += 0.42 * low;
  const double distance = (grip - chest_of(skeleton, posture).translation()).norm();
  const double lean = std::clamp(1.6 * (distance / skeleton.scale - kEasyReachM), 0.0, 0.7);
  posture.spine_rpy.y() += lean;
  posture.head_rpy.y() += 0.2 * low - 0.3 * lean;
  for (const Side side : kBothSides) {
    const std::size_t i = index_of(side);
    posture.wrists_m.at(i) =
        grip + Eigen::Vector3d(-0.07 * skeleton.scale, sign_of(side) * held.half_width_m, 0.0);
    posture.elbows_towards.at(i) = {-0.5, sign_of(side) * 0.5, -0.8};
    posture.palms_rad.at(i) = held.palm_rad;
  }
}

/// From standing to seated: back and down, the trunk leaning forward on the way.
void sit_down(const Sitting& sitting, double progress, Posture& posture) {
  const double seated = mixed_values(sitting.from, sitting.to, eased(progress));
  const double lean = std::sin(kPi * seated);
  posture.pelvis_m.x() -= sitting.back_m * eased(1.1 * seated);
  posture.pelvis_m.z() = mixed_values(posture.pelvis_m.z(), sitting.hips_z_m, seated);
  posture.pelvis_rpy.y() += 0.25 * lean - 0.12 * seated;
  posture.spine_rpy.y() += 0.42 * lean + 0.14 * seated;
  posture.head_rpy.y() -= 0.25 * lean;
}

FloorPose place_in(const Segment& segment, double time_s) {
  if (!segment.motion) return segment.place;
  const Motion& motion = *segment.motion;
  return motion.route.person_at(motion.profile.along_m(time_s - segment.begin_s));
}

}  // namespace

double hips_above_seat_m(const Skeleton& skeleton) { return 0.125 * skeleton.scale; }

std::size_t Timeline::add(const Segment& segment) {
  segments_.push_back(segment);
  return segments_.size() - 1;
}

std::size_t Timeline::segment_at(double time_s) const {
  const auto next =
      std::upper_bound(segments_.begin(), segments_.end(), time_s,
                       [](double time, const Segment& segment) { return time < segment.begin_s; });
  return next == segments_.begin() ? 0 : static_cast<std::size_t>(next - segments_.begin()) - 1;
}

FloorPose Timeline::place_at(double time_s) const {
  return place_in(segments_[segment_at(time_s)], time_s);
}

SE3 Timeline::T_world_person(double time_s) const { return to_transform(place_at(time_s)); }

SE3 Timeline::T_world_held(std::size_t segment, double time_s) const {
  const Segment& holding = segments_.at(segment);
  const SE3 T_person_held{
      Eigen::Quaterniond(Eigen::AngleAxisd(holding.held->yaw_rad, Eigen::Vector3d::UnitZ())),
      held_at(holding, time_s)};
  return to_transform(place_in(holding, time_s)) * T_person_held;
}

Posture Timeline::posture_in(const Segment& segment, double time_s) const {
  const GestureMoment moment{time_s, segment.sitting.has_value(), seed_};
  Posture posture;
  if (segment.motion) {
    const Motion& motion = *segment.motion;
    posture =
        motion.gait.at(skeleton_, motion.route, motion.profile.along_m(time_s - segment.begin_s));
    add_glances(moment, 0.6, posture);
  } else {
    posture = standing_posture(skeleton_);
    if (segment.sitting) sit_down(*segment.sitting, progress_of(segment, time_s), posture);
    add_idle_motion(moment, posture);
    settle_pelvis(skeleton_, posture);
    add_gesture(skeleton_, segment.gesture, moment, posture);
  }
  if (segment.held) reach_for(skeleton_, *segment.held, held_at(segment, time_s), posture);
  return posture;
}

Posture Timeline::posture_at(double time_s) const {
  const std::size_t i = segment_at(time_s);
  const Segment& segment = segments_[i];
  Posture posture = posture_in(segment, time_s);
  const double share = (time_s - segment.begin_s) / segment.fade_s;
  if (i == 0 || share >= 1.0) return posture;
  return blended(posture_in(segments_[i - 1], time_s), posture, eased(share));
}

}  // namespace tsg::simulation
