#include "common/simulation/people/posture.hpp"

#include <algorithm>
#include <cmath>

#include "common/simulation/people/easing.hpp"

namespace tsg::simulation {
namespace {

constexpr double kStraightest = 0.997;    // share of its length that a limb stretches to
constexpr double kStandingBendM = 0.012;  // knees of one who stands are not quite straight
constexpr double kHeelBehindAnkleM = 0.045;

Eigen::Quaterniond rotation_of(const Eigen::Vector3d& rpy) {
  return Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX());
}

/// Axes of a bone along `direction` whose joint turns about `hinge`; both unit, at right angles.
Eigen::Matrix3d bone_axes(const Eigen::Vector3d& direction, const Eigen::Vector3d& hinge) {
  Eigen::Matrix3d axes;
  axes << hinge, direction.cross(hinge), direction;
  return axes;
}

struct LimbTask {
  Eigen::Vector3d root_m;
  Eigen::Vector3d target_m;
  Eigen::Vector3d bend_towards;
  double upper_m;
  double lower_m;
};

struct LimbSolution {
  Eigen::Vector3d upper;  ///< directions, unit
  Eigen::Vector3d lower;
  Eigen::Vector3d hinge;
};

/// Two bones from `root_m` to `target_m`: law of cosines.
LimbSolution solve_limb(const LimbTask& task) {
  const Eigen::Vector3d offset = task.target_m - task.root_m;
  const double nearest = std::abs(task.upper_m - task.lower_m) + 0.02;
  const double distance =
      std::clamp(offset.norm(), nearest, kStraightest * (task.upper_m + task.lower_m));
  const Eigen::Vector3d direction = offset.normalized();
  const Eigen::Vector3d hinge = direction.cross(task.bend_towards).normalized();
  const Eigen::Vector3d outwards = hinge.cross(direction);
  const double cosine =
      (task.upper_m * task.upper_m + distance * distance - task.lower_m * task.lower_m) /
      (2.0 * task.upper_m * distance);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const Eigen::Vector3d upper = cosine * direction + sine * outwards;
  const Eigen::Vector3d lower = (distance * direction - task.upper_m * upper).normalized();
  return {upper, lower, hinge};
}

/// Places the bones of a leg below the pelvis.
void solve_leg(const Skeleton& skeleton, const Posture& posture, Side side, BonePoses& bones) {
  const FootPosture& foot = posture.feet.at(index_of(side));
  const SE3& T_person_pelvis = bones[index_of(Bone::kPelvis)];
  const Eigen::Vector3d hip =
      T_person_pelvis * (skeleton.joint(side, LimbBone::kThigh) - skeleton.joint(Bone::kPelvis));
  const double knee_yaw = 0.5 * (foot.yaw_rad + posture.pelvis_rpy.z());
  const Eigen::Vector3d forward{std::cos(knee_yaw), std::sin(knee_yaw), 0.0};
  const LimbSolution leg = solve_limb({hip, foot.ankle_m, forward + Eigen::Vector3d(0, 0, 0.15),
                                       skeleton.thigh_m, skeleton.shin_m});
  const Eigen::Matrix3d rest =
      bone_axes(-Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()).transpose();
  const Eigen::Vector3d knee = hip + skeleton.thigh_m * leg.upper;
  const Eigen::Vector3d ankle = knee + skeleton.shin_m * leg.lower;
  bones.at(index_of(side, LimbBone::kThigh)) = {bone_axes(leg.upper, leg.hinge) * rest, hip};
  bones.at(index_of(side, LimbBone::kShin)) = {bone_axes(leg.lower, leg.hinge) * rest, knee};
  const SE3 T_person_foot{rotation_of({0.0, -foot.pitch_rad, foot.yaw_rad}), ankle};
  bones.at(index_of(side, LimbBone::kFoot)) = T_person_foot;
  // Toes stay flat on the floor while the heel is up.
  const SE3 T_foot_toes{
      rotation_of({0.0, std::min(0.0, foot.pitch_rad), 0.0}),
      skeleton.joint(side, LimbBone::kToes) - skeleton.joint(side, LimbBone::kFoot)};
  bones.at(index_of(side, LimbBone::kToes)) = T_person_foot * T_foot_toes;
}

/// Places the bones of an arm below the chest.
void solve_arm(const Skeleton& skeleton, const Posture& posture, Side side, BonePoses& bones) {
  const std::size_t i = index_of(side);
  const Eigen::Vector3d shoulder =
      bones[index_of(Bone::kChest)] *
      (skeleton.joint(side, LimbBone::kUpperArm) - skeleton.joint(Bone::kChest));
  const LimbSolution arm =
      solve_limb({shoulder, posture.wrists_m.at(i), posture.elbows_towards.at(i),
                  skeleton.upper_arm_m, skeleton.lower_arm_m});
  const Eigen::Vector3d rest_direction = rest_arm_direction(side);
  const Eigen::Vector3d rest_hinge = rest_direction.cross(-Eigen::Vector3d::UnitX()).normalized();
  const Eigen::Matrix3d rest = bone_axes(rest_direction, rest_hinge).transpose();
  const Eigen::Vector3d elbow = shoulder + skeleton.upper_arm_m * arm.upper;
  const Eigen::Vector3d wrist = elbow + skeleton.lower_arm_m * arm.lower;
  const auto turned = [&](double share) -> Eigen::Matrix3d {
    const double angle = sign_of(side) * share * posture.palms_rad.at(i);
    return Eigen::AngleAxisd(angle, arm.lower) * (bone_axes(arm.lower, arm.hinge) * rest);
  };
  bones.at(index_of(side, LimbBone::kUpperArm)) = {bone_axes(arm.upper, arm.hinge) * rest,
                                                   shoulder};
  bones.at(index_of(side, LimbBone::kLowerArm)) = {turned(0.4), elbow};
  bones.at(index_of(side, LimbBone::kHand)) = {turned(1.0), wrist};
}

/// The lesser of two numbers, without a kink where they meet.
double smooth_min(double a, double b, double width) {
  const double share = std::clamp(0.5 + 0.5 * (b - a) / width, 0.0, 1.0);
  return mixed_values(b, a, share) - width * share * (1.0 - share);
}

/// As high as both legs reach from where the feet are.
double reachable_pelvis_z(const Skeleton& skeleton, const Posture& posture) {
  const double length = 0.995 * kStraightest * (skeleton.thigh_m + skeleton.shin_m);
  const Eigen::Quaterniond rotation = rotation_of(posture.pelvis_rpy);
  double height = posture.pelvis_m.z();
  for (const Side side : kBothSides) {
    const Eigen::Vector3d hip =
        rotation * (skeleton.joint(side, LimbBone::kThigh) - skeleton.joint(Bone::kPelvis));
    const Eigen::Vector3d& ankle = posture.feet.at(index_of(side)).ankle_m;
    const double across = (posture.pelvis_m + hip - ankle).head<2>().norm();
    const double up = std::sqrt(std::max(0.01, length * length - across * across));
    height = smooth_min(height, ankle.z() + up - hip.z(), 0.012 * skeleton.scale);
  }
  return height;
}

}  // namespace

double half_stance_m(const Skeleton& skeleton) {
  return skeleton.joint(Side::kLeft, LimbBone::kThigh).y() + 0.01 * skeleton.scale;
}

FootPosture make_foot(const Skeleton& skeleton,
                      const Eigen::Vector3d& sole_m,
                      double yaw_rad,
                      double pitch_rad) {
  const Eigen::Vector3d ankle{0.0, 0.0, skeleton.joint(Side::kLeft, LimbBone::kFoot).z()};
  const Eigen::Vector3d toes = skeleton.joint(Side::kLeft, LimbBone::kToes);
  const Eigen::Vector3d pivot{pitch_rad > 0.0 ? -kHeelBehindAnkleM * skeleton.scale : toes.x(), 0.0,
                              0.0};
  const Eigen::Vector3d tilted = pivot + rotation_of({0.0, -pitch_rad, 0.0}) * (ankle - pivot);
  return {sole_m + rotation_of({0.0, 0.0, yaw_rad}) * tilted, yaw_rad, pitch_rad};
}

Posture standing_posture(const Skeleton& skeleton) {
  Posture posture;
  posture.pelvis_m = skeleton.joint(Bone::kPelvis);
  posture.pelvis_m.z() -= kStandingBendM * skeleton.scale;
  for (const Side side : kBothSides) {
    let_arm_hang(skeleton, side, 0.03, 0.18, posture);
    posture.feet.at(index_of(side)) = make_foot(
        skeleton, {0.0, sign_of(side) * half_stance_m(skeleton), 0.0}, sign_of(side) * 0.1, 0.0);
  }
  return posture;
}

Posture blended(const Posture& from, const Posture& to, double share) {
  Posture result = to;
  result.pelvis_m = mixed_values(from.pelvis_m, to.pelvis_m, share);
  result.pelvis_rpy = mixed_values(from.pelvis_rpy, to.pelvis_rpy, share);
  result.spine_rpy = mixed_values(from.spine_rpy, to.spine_rpy, share);
  result.head_rpy = mixed_values(from.head_rpy, to.head_rpy, share);
  for (const Side side : kBothSides) {
    const std::size_t i = index_of(side);
    result.wrists_m.at(i) = mixed_values(from.wrists_m.at(i), to.wrists_m.at(i), share);
    result.elbows_towards.at(i) =
        mixed_values(from.elbows_towards.at(i), to.elbows_towards.at(i), share);
    result.palms_rad.at(i) = mixed_values(from.palms_rad.at(i), to.palms_rad.at(i), share);
  }
  return result;
}

SE3 chest_of(const Skeleton& skeleton, const Posture& posture) {
  const Eigen::Quaterniond half_spine = rotation_of(0.5 * posture.spine_rpy);
  const SE3 T_person_pelvis{rotation_of(posture.pelvis_rpy), posture.pelvis_m};
  const SE3 T_pelvis_spine{half_spine,
                           skeleton.joint(Bone::kSpine) - skeleton.joint(Bone::kPelvis)};
  const SE3 T_spine_chest{half_spine, skeleton.joint(Bone::kChest) - skeleton.joint(Bone::kSpine)};
  return T_person_pelvis * T_pelvis_spine * T_spine_chest;
}

void let_arm_hang(
    const Skeleton& skeleton, Side side, double swing_rad, double bend_rad, Posture& posture) {
  const auto along = [side](double angle) -> Eigen::Vector3d {
    return Eigen::Vector3d(std::sin(angle), sign_of(side) * 0.13, -std::cos(angle)).normalized();
  };
  const Eigen::Vector3d wrist = skeleton.joint(side, LimbBone::kUpperArm) +
                                skeleton.upper_arm_m * along(swing_rad) +
                                skeleton.lower_arm_m * along(swing_rad + bend_rad);
  const SE3 T_person_chest = chest_of(skeleton, posture);
  const std::size_t i = index_of(side);
  posture.wrists_m.at(i) = T_person_chest * (wrist - skeleton.joint(Bone::kChest));
  posture.elbows_towards.at(i) =
      T_person_chest.rotation() *
      Eigen::Vector3d(-std::cos(swing_rad), sign_of(side) * 0.35, -std::sin(swing_rad));
  posture.palms_rad.at(i) = 0.35;
}

void settle_pelvis(const Skeleton& skeleton, Posture& posture) {
  posture.pelvis_m.z() = reachable_pelvis_z(skeleton, posture);
}

BonePoses solve(const Skeleton& skeleton, const Posture& posture) {
  Posture settled = posture;
  settle_pelvis(skeleton, settled);
  BonePoses bones;
  const auto attach = [&](Bone bone, Bone parent, const Eigen::Vector3d& rpy) {
    const SE3 T_parent_bone{rotation_of(rpy), skeleton.joint(bone) - skeleton.joint(parent)};
    bones.at(index_of(bone)) = bones.at(index_of(parent)) * T_parent_bone;
  };
  bones[index_of(Bone::kPelvis)] = {rotation_of(settled.pelvis_rpy), settled.pelvis_m};
  attach(Bone::kSpine, Bone::kPelvis, 0.5 * settled.spine_rpy);
  attach(Bone::kChest, Bone::kSpine, 0.5 * settled.spine_rpy);
  attach(Bone::kNeck, Bone::kChest, 0.45 * settled.head_rpy);
  attach(Bone::kHead, Bone::kNeck, 0.55 * settled.head_rpy);
  for (const Side side : kBothSides) {
    solve_leg(skeleton, settled, side, bones);
    solve_arm(skeleton, settled, side, bones);
  }
  return bones;
}

}  // namespace tsg::simulation
