#pragma once

#include "common/simulation/people/look.hpp"
#include "common/simulation/people/skinning.hpp"

namespace tsg::simulation {

/// Materials of a body, by their place in Mesh::materials.
enum class BodyMaterial : std::uint32_t {
  kSkin,
  kFace,
  kHair,
  kTop,
  kSleeve,
  kBottom,
  kLegs,
  kShoes
};

[[nodiscard]] constexpr std::uint32_t material_of(BodyMaterial material) {
  return static_cast<std::uint32_t>(material);
}

/// A clothed person at rest.
[[nodiscard]] SkinnedMesh make_body(const Skeleton& skeleton, const Look& look);

/// Parts of it, added to a mesh that has the materials.
void add_trunk(const Skeleton& skeleton, const Look& look, SkinnedMesh& mesh);
void add_leg(const Skeleton& skeleton, const Look& look, Side side, SkinnedMesh& mesh);
void add_arm(const Skeleton& skeleton, const Look& look, Side side, SkinnedMesh& mesh);
void add_hand(const Skeleton& skeleton, Side side, SkinnedMesh& mesh);
void add_shoe(const Skeleton& skeleton, Side side, SkinnedMesh& mesh);
void add_head(const Skeleton& skeleton, const Look& look, SkinnedMesh& mesh);

}  // namespace tsg::simulation
