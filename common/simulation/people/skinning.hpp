#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/render/mesh.hpp"
#include "common/simulation/people/skeleton.hpp"

namespace tsg::simulation {

/// Which bones a point goes with, and how much with each; the weights sum to 1.
struct Skin {
  std::array<std::uint8_t, 3> bones{};
  std::array<float, 3> weights{1.0F, 0.0F, 0.0F};
};

[[nodiscard]] Skin skin_of(std::size_t bone);
/// `share` 0: all `a`; 1: all `b`.
[[nodiscard]] Skin skin_between(std::size_t a, std::size_t b, float share);
[[nodiscard]] Skin skin_of_three(const std::array<std::size_t, 3>& bones,
                                 const std::array<float, 3>& weights);

/// A mesh at rest with a skin for each of its points.
struct SkinnedMesh {
  render::Mesh rest;
  std::vector<Skin> skins;
};

/// Linear blend skinning: points and unit normals in the world of a body whose bones are posed.
/// `bones`: T_person_bone.
void deform(const SkinnedMesh& mesh,
            const Skeleton& skeleton,
            const std::pair<SE3, BonePoses>& T_world_person_and_bones,
            std::vector<Eigen::Vector3f>& points,
            std::vector<Eigen::Vector3f>& normals);

}  // namespace tsg::simulation
