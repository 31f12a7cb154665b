#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/render/mesh.hpp"

namespace tsg::simulation {

/// Where one can sit: in the axes of the model.
struct Seat {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< top of the cushion; one faces +x
};

/// A piece of the catalogue. Axes: origin at the centre of its base, front +x, z up.
struct FurnitureModel {
  std::string class_name;  ///< COCO class, or another noun where COCO has none, e.g. "bookshelf"
  render::Mesh mesh;
  double top_m = 0.0;  ///< height of the surface that things can stand on; 0: none
  std::optional<Seat> seat;
  Eigen::Vector2d half_size_m = Eigen::Vector2d::Zero();  ///< half of its extent in x and y
  double grip_height_m = 0.9;                             ///< where hands take it to push it
};

/// All types that make_furniture() knows, sorted.
[[nodiscard]] std::vector<std::string> furniture_types();

/// Builds a model; `look` picks colours, patterns and small differences. The same arguments give
/// the same model, bit for bit. `type` must be one of furniture_types().
[[nodiscard]] FurnitureModel make_furniture(const std::string& type, std::uint64_t look);

}  // namespace tsg::simulation
