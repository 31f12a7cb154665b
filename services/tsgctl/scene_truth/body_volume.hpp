#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "services/tsgctl/scene_truth/voxel_set.hpp"

namespace tsg {

/// A surface of triangles, in the axes of the voxels; metres.
struct Surface {
  std::span<const Eigen::Vector3f> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Adds the voxels that a surface passes through. A corner of a voxel that it cuts by less than a
/// quarter of its edge may be missed.
void add_surface(const Surface& surface, VoxelSet& voxels);

/// Adds these and what the surface encloses.
void add_body(const Surface& surface, VoxelSet& voxels);

}  // namespace tsg
