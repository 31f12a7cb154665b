#pragma once

#include <Eigen/Core>
#include <array>
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

/// The light that bounces through the open space of a room, on a grid: for what moves.
class BouncedLightField {
 public:
  BouncedLightField(const Layer& layer, const BakedLight& light);

  /// Light on a surface there.
  [[nodiscard]] Eigen::Vector3f at(const SurfacePoint& point) const;

 private:
  /// Light on little plates that face +x -x +y -y +z -z.
  using Cube = std::array<Eigen::Vector3f, 6>;
  struct Probe {
    Cube light;
    float weight = 0.0F;  ///< 0 inside walls and furniture
  };

  [[nodiscard]] Probe measure(const Layer& layer, const BakedLight& light, std::size_t index) const;
  [[nodiscard]] Eigen::Vector3f position(std::size_t index) const;
  [[nodiscard]] std::size_t index_of(const Eigen::Vector3i& cell) const;

  Eigen::Vector3f origin_m_;
  Eigen::Vector3i size_;
  std::vector<Probe> probes_;
};

/// How open the surroundings of each point of a body are, 0..1, by its own shape at rest: darkens
/// armpits and folds.
[[nodiscard]] std::vector<float> bake_openness(const Layer& body);

}  // namespace tsg::render
