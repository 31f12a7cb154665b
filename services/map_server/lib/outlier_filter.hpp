#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "services/map_server/lib/cloud.hpp"
#include "services/map_server/lib/voxel_grid.hpp"

namespace tsg {

/// Which points lie apart from all others (docs/decisions/0013-cloud-filters.md).
struct OutlierConfig {
  int neighbours = 6;      ///< whose mean distance counts; 0: nothing is taken out
  double max_sigma = 3.0;  ///< standard deviations above the mean of all points
  /// Points that are closer to their neighbours are never taken out: poles, cables, the corner of a
  /// wall that has no other point apart.
  double kept_within_m = 0.2;

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// The statistical outlier filter (paper, section 5): takes out what is farther from its nearest
/// neighbours than most points are from theirs. Looks at the cloud in voxels of 5 cm, a leaf of the
/// map: points are as dense there far away as nearby, and few. One owner.
class OutlierFilter {
 public:
  explicit OutlierFilter(const OutlierConfig& config);

  /// Takes the outliers out of `cloud`, keeping the order of the rest; how many they were. The same
  /// cloud always gives the same; of fewer voxels than neighbours nothing is taken out.
  std::size_t apply(Cloud& cloud);

 private:
  OutlierConfig config_;
  VoxelGrid coarse_;  // of the cloud being filtered
};

}  // namespace tsg
