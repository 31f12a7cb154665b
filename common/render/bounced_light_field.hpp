#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "common/render/baked_light.hpp"
#include "common/render/lamp_light.hpp"
#include "common/render/layer.hpp"

namespace tsg::render {

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

}  // namespace tsg::render
