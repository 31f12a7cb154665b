#pragma once

#include <Eigen/Geometry>

#include "services/map_server/lib/tags/tag.hpp"
#include "services/map_server/lib/tags/tag_cells.hpp"

namespace tsg {

/// Where a tag is and how large.
struct TagShape {
  Eigen::AlignedBox3f box;  ///< along the axes of the map
  /// That of least ground area; its x axis is the longer one. Along the axes of the map where no
  /// other direction saves some space.
  UprightBox oriented_box;
};

/// By the voxels that were seen often enough, each moved along its ray to the surface that depth
/// noise smeared, without the outermost along each axis. `cells` must not be empty.
[[nodiscard]] TagShape measure_shape(const TagCells& cells);

/// The box along the axes of the map, quickly: without what noise adds and takes. Empty where
/// `cells` is.
[[nodiscard]] Eigen::AlignedBox3f rough_box(const TagCells& cells);

}  // namespace tsg
