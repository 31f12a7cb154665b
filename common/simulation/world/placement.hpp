#pragma once

#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/geometry/se3.hpp"
#include "common/simulation/furniture/catalogue.hpp"
#include "common/simulation/scene.hpp"

namespace tsg::simulation {

/// An object of a scene with its model, where it stands at first.
struct PlacedObject {
  ObjectDescription description;
  FurnitureModel model;  ///< in the size that the scene asks for
  SE3 T_support_object;  ///< in the axes of what it stands on; of the world on the floor
  SE3 T_world_object;
};

/// Takes the models from the catalogue and places them, each behind the one it stands on. kBadData
/// names the object: of an unknown type, a name given twice, nothing to stand on.
[[nodiscard]] Expected<std::vector<PlacedObject>> place_objects(const SceneDescription& scene);

/// A pose on the floor, lifted by `z_m`.
[[nodiscard]] SE3 pose_at(const FloorPose& pose, double z_m);

}  // namespace tsg::simulation
