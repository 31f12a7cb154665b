#include "common/simulation/people/skeleton.hpp"

#include <cmath>

namespace tsg::simulation {
namespace {

constexpr double kReferenceHeight = 1.75;

}  // namespace

Eigen::Vector3d rest_arm_direction(Side side) {
  return {0.0, sign_of(side) * std::sin(kRestArmAngle), -std::cos(kRestArmAngle)};
}

Skeleton make_skeleton(double height_m, double shoulder_width, double hip_width) {
  Skeleton skeleton;
  skeleton.height_m = height_m;
  skeleton.scale = height_m / kReferenceHeight;
  skeleton.upper_arm_m = 0.285 * skeleton.scale;
  skeleton.lower_arm_m = 0.255 * skeleton.scale;
  skeleton.thigh_m = 0.41 * skeleton.scale;
  skeleton.shin_m = 0.405 * skeleton.scale;
  const auto set = [&skeleton](std::size_t bone, const Eigen::Vector3d& joint) {
    skeleton.joints_m.at(bone) = skeleton.scale * joint;
  };
  set(index_of(Bone::kPelvis), {0.0, 0.0, 0.94});
  set(index_of(Bone::kSpine), {-0.01, 0.0, 1.04});
  set(index_of(Bone::kChest), {-0.01, 0.0, 1.20});
  set(index_of(Bone::kNeck), {-0.015, 0.0, 1.45});
  set(index_of(Bone::kHead), {0.0, 0.0, 1.545});
  for (const Side side : kBothSides) {
    const double sign = sign_of(side);
    const Eigen::Vector3d arm = rest_arm_direction(side);
    const Eigen::Vector3d shoulder{-0.01, sign * 0.172 * shoulder_width, 1.405};
    const Eigen::Vector3d hip{0.0, sign * 0.09 * hip_width, 0.90};
    set(index_of(side, LimbBone::kUpperArm), shoulder);
    set(index_of(side, LimbBone::kLowerArm), shoulder + 0.285 * arm);
    set(index_of(side, LimbBone::kHand), shoulder + 0.54 * arm);
    set(index_of(side, LimbBone::kThigh), hip);
    set(index_of(side, LimbBone::kShin), hip - Eigen::Vector3d(0, 0, 0.41));
    set(index_of(side, LimbBone::kFoot), hip - Eigen::Vector3d(0, 0, 0.815));
    set(index_of(side, LimbBone::kToes), {0.125, hip.y(), 0.02});
  }
  return skeleton;
}

}  // namespace tsg::simulation
