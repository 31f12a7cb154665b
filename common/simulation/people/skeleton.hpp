#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "common/geometry/se3.hpp"

namespace tsg::simulation {

enum class Side { kLeft = 0, kRight = 1 };
inline constexpr std::array<Side, 2> kBothSides{Side::kLeft, Side::kRight};

[[nodiscard]] constexpr std::size_t index_of(Side side) { return static_cast<std::size_t>(side); }
[[nodiscard]] constexpr Side other_side(Side side) {
  return side == Side::kLeft ? Side::kRight : Side::kLeft;
}
/// Of y: one's left is +y.
[[nodiscard]] constexpr double sign_of(Side side) { return side == Side::kLeft ? 1.0 : -1.0; }

/// The bones of the trunk come first, then those of each side in the order of LimbBone.
enum class Bone : std::size_t { kPelvis, kSpine, kChest, kNeck, kHead };
enum class LimbBone : std::size_t { kUpperArm, kLowerArm, kHand, kThigh, kShin, kFoot, kToes };
inline constexpr std::size_t kTrunkBones = 5;
inline constexpr std::size_t kLimbBones = 7;
inline constexpr std::size_t kBones = kTrunkBones + 2 * kLimbBones;

[[nodiscard]] constexpr std::size_t index_of(Bone bone) { return static_cast<std::size_t>(bone); }
[[nodiscard]] constexpr std::size_t index_of(Side side, LimbBone bone) {
  return kTrunkBones + kLimbBones * index_of(side) + static_cast<std::size_t>(bone);
}

// The bones of the trunk as indices.
inline constexpr std::size_t kPelvis = index_of(Bone::kPelvis);
inline constexpr std::size_t kSpine = index_of(Bone::kSpine);
inline constexpr std::size_t kChest = index_of(Bone::kChest);
inline constexpr std::size_t kNeck = index_of(Bone::kNeck);
inline constexpr std::size_t kHead = index_of(Bone::kHead);

/// Where the joints are while a person stands at rest: arms held off the body by
/// kRestArmAngle, feet together. Person's axes: origin on the floor below the pelvis, front +x.
/// A bone's axes have their origin at its upper joint and at rest point the same way.
struct Skeleton {
  double height_m = 0.0;
  double scale = 1.0;  ///< size relative to the adult of 1.75 m that lengths are written down for
  std::array<Eigen::Vector3d, kBones> joints_m;
  double upper_arm_m = 0.0;
  double lower_arm_m = 0.0;
  double thigh_m = 0.0;
  double shin_m = 0.0;

  [[nodiscard]] const Eigen::Vector3d& joint(Bone bone) const { return joints_m[index_of(bone)]; }
  [[nodiscard]] const Eigen::Vector3d& joint(Side side, LimbBone bone) const {
    return joints_m.at(index_of(side, bone));
  }
};

/// Angle between arm and body at rest, radians: half-way between hanging and stretched out, so that
/// shoulders bend well both ways.
inline constexpr double kRestArmAngle = 0.6;

/// Where the arm points at rest.
[[nodiscard]] Eigen::Vector3d rest_arm_direction(Side side);

/// Proportions of an adult (Drillis and Contini 1966, rounded). `shoulder_width` and `hip_width`
/// are relative to the mean.
[[nodiscard]] Skeleton make_skeleton(double height_m, double shoulder_width, double hip_width);

/// T_person_bone of each bone.
using BonePoses = std::array<SE3, kBones>;

}  // namespace tsg::simulation
