#pragma once

#include <Eigen/Core>
#include <array>

#include "common/simulation/people/skeleton.hpp"

namespace tsg::simulation {

/// A foot in the person's axes. `pitch_rad` > 0: toes up, standing on the heel; < 0: heel up,
/// standing on the ball of the foot.
struct FootPosture {
  Eigen::Vector3d ankle_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
};

/// How a body is held: few numbers that can be blended, from which bones follow. Person's axes:
/// origin on the floor, front +x. Angles: (roll, pitch, yaw), pitch > 0 bends forward.
struct Posture {
  Eigen::Vector3d pelvis_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d pelvis_rpy = Eigen::Vector3d::Zero();
  Eigen::Vector3d spine_rpy = Eigen::Vector3d::Zero();  ///< of the chest against the pelvis
  Eigen::Vector3d head_rpy = Eigen::Vector3d::Zero();   ///< against the chest
  std::array<Eigen::Vector3d, 2> wrists_m{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<Eigen::Vector3d, 2> elbows_towards{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<double, 2> palms_rad{};  ///< 0: thumb up with the forearm level; > 0: palm down
  std::array<FootPosture, 2> feet;
};

/// Where the ankle of a foot is that stands at (x, y) of `sole_m`, `lift_m` above the floor.
[[nodiscard]] FootPosture make_foot(const Skeleton& skeleton,
                                    const Eigen::Vector3d& sole_m,
                                    double yaw_rad,
                                    double pitch_rad);

/// Upright, arms hanging, feet side by side.
[[nodiscard]] Posture standing_posture(const Skeleton& skeleton);

/// Half the distance between the ankles of one who stands.
[[nodiscard]] double half_stance_m(const Skeleton& skeleton);

/// Everything but the feet, which keep the places of `to`. `share` 0: `from`; 1: `to`.
[[nodiscard]] Posture blended(const Posture& from, const Posture& to, double share);

/// T_person_chest as pelvis and spine of `posture` have it.
[[nodiscard]] SE3 chest_of(const Skeleton& skeleton, const Posture& posture);

/// An arm that hangs from the shoulder: swung forward by `swing_rad`, bent by `bend_rad`.
void let_arm_hang(
    const Skeleton& skeleton, Side side, double swing_rad, double bend_rad, Posture& posture);

/// Lowers the pelvis as far as the legs need to reach the feet; for postures to which hands are
/// added afterwards.
void settle_pelvis(const Skeleton& skeleton, Posture& posture);

/// All bones: forward kinematics of the trunk, two-bone inverse kinematics of the limbs; settles
/// the pelvis. Hands that are out of reach stay on the
/// line from the shoulder.
[[nodiscard]] BonePoses solve(const Skeleton& skeleton, const Posture& posture);

}  // namespace tsg::simulation
