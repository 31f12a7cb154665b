#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/geometry/se3.hpp"
#include "common/simulation/people/gait.hpp"
#include "common/simulation/people/gestures.hpp"
#include "common/simulation/people/posture.hpp"
#include "common/simulation/people/route.hpp"

namespace tsg::simulation {

/// A thing between two hands. It goes from `from_m` to `to_m` (the middle of its base, in the
/// person's axes) while the segment lasts.
struct Held {
  std::size_t prop = 0;  ///< which one, by the order of names
  bool moves = true;     ///< false: hands are on it, but it stands where it stood
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;        ///< of it against the person
  double grip_back_m = 0.0;    ///< hands are nearer than its middle by this
  double grip_height_m = 0.0;  ///< and above its base by this
  double half_width_m = 0.2;   ///< half the distance between the hands
  double palm_rad = 0.0;       ///< see Posture
};

/// A seat behind one who stands in front of it.
struct Sitting {
  double from = 0.0;      ///< 0 standing .. 1 seated, when the segment begins
  double to = 1.0;        ///< and when it ends
  double back_m = 0.4;    ///< from between the feet back to where the hips come to rest
  double hips_z_m = 0.5;  ///< height of the pelvis above the floor then
};

/// A walk along a route.
struct Motion {
  Route route;
  SpeedProfile profile;
  Gait gait;
};

/// What a person does from `begin_s` to `end_s`; without motion: at `place`.
struct Segment {
  double begin_s = 0.0;
  double end_s = 0.0;
  double fade_s = 0.45;  ///< in which trunk and arms come over from the segment before
  FloorPose place;
  std::optional<Motion> motion;
  std::optional<Sitting> sitting;
  std::optional<Held> held;
  Gesture gesture = Gesture::kIdle;
};

/// How high above its seat the hips of one who sits are.
[[nodiscard]] double hips_above_seat_m(const Skeleton& skeleton);

/// All that one person does, in order and without gaps from 0 s on; the last segment goes on.
/// Immutable once filled.
class Timeline {
 public:
  // NOLINTNEXTLINE(modernize-pass-by-value): nothing in a skeleton could be moved
  Timeline(const Skeleton& skeleton, std::uint64_t seed) : skeleton_(skeleton), seed_(seed) {}

  /// Appends what comes next; returns its number.
  std::size_t add(const Segment& segment);

  [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
  [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }
  /// Where the person is: on the floor, between the feet while standing.
  [[nodiscard]] FloorPose place_at(double time_s) const;
  [[nodiscard]] SE3 T_world_person(double time_s) const;
  [[nodiscard]] Posture posture_at(double time_s) const;
  /// What is held in a segment, as if the segment went on for ever.
  [[nodiscard]] SE3 T_world_held(std::size_t segment, double time_s) const;

 private:
  [[nodiscard]] std::size_t segment_at(double time_s) const;
  [[nodiscard]] Posture posture_in(const Segment& segment, double time_s) const;

  Skeleton skeleton_;
  std::uint64_t seed_;
  std::vector<Segment> segments_;
};

}  // namespace tsg::simulation
