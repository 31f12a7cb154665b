#include "common/simulation/people/skinning.hpp"

namespace tsg::simulation {
namespace {

using Affine = Eigen::Matrix<float, 3, 4>;

}  // namespace

Skin skin_of(std::size_t bone) { return skin_between(bone, bone, 0.0F); }

Skin skin_between(std::size_t a, std::size_t b, float share) {
  return skin_of_three({a, b, b}, {1.0F - share, share, 0.0F});
}

Skin skin_of_three(const std::array<std::size_t, 3>& bones, const std::array<float, 3>& weights) {
  Skin skin;
  for (std::size_t i = 0; i < 3; ++i) {
    skin.bones.at(i) = static_cast<std::uint8_t>(bones.at(i));
    skin.weights.at(i) = weights.at(i);
  }
  return skin;
}

void deform(const SkinnedMesh& mesh,
            const Skeleton& skeleton,
            const std::pair<SE3, BonePoses>& T_world_person_and_bones,
            std::vector<Eigen::Vector3f>& points,
            std::vector<Eigen::Vector3f>& normals) {
  const auto& [T_world_person, bones] = T_world_person_and_bones;
  std::array<Affine, kBones> T_world_rest;  // of each bone: person's axes at rest to the world
  for (std::size_t i = 0; i < kBones; ++i) {
    const SE3 T_world_bone = T_world_person * bones.at(i);
    const Eigen::Matrix3d rotation = T_world_bone.rotation_matrix();
    T_world_rest.at(i).leftCols<3>() = rotation.cast<float>();
    T_world_rest.at(i).col(3) =
        (T_world_bone.translation() - rotation * skeleton.joints_m.at(i)).cast<float>();
  }
  points.resize(mesh.rest.points.size());
  normals.resize(mesh.rest.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Skin& skin = mesh.skins[i];
    const Affine blend = skin.weights[0] * T_world_rest[skin.bones[0]] +
                         skin.weights[1] * T_world_rest[skin.bones[1]] +
                         skin.weights[2] * T_world_rest[skin.bones[2]];
    points[i] = blend.leftCols<3>() * mesh.rest.points[i] + blend.col(3);
    normals[i] = (blend.leftCols<3>() * mesh.rest.normals[i]).normalized();
  }
}

}  // namespace tsg::simulation
