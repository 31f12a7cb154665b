#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/render/lamp_light.hpp"
#include "common/render/layer.hpp"

namespace tsg::render {

/// The light on the corners of what never moves, as nothing that moves takes any of it away.
struct BakedLight {
  std::vector<SurfacePoint> places;      ///< where the light of each corner is computed
  std::vector<StrongLamps> strong;       ///< what the brightest lamps give, with shadows
  std::vector<Eigen::Vector3f> rest;     ///< of the other lamps, with shadows
  std::vector<Eigen::Vector3f> bounced;  ///< from the surfaces around
  std::vector<Eigen::Vector3f> total;    ///< all of these together
};

/// Computes lamps with soft shadows, and light that bounces twice (further bounces are estimated).
/// All cores; seconds for a furnished room.
[[nodiscard]] BakedLight bake_light(const Layer& layer, const std::vector<Lamp>& lamps);

/// How open the surroundings of each point of a body are, 0..1, by its own shape at rest: darkens
/// armpits and folds.
[[nodiscard]] std::vector<float> bake_openness(const Layer& body);

}  // namespace tsg::render
