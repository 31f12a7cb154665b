#pragma once

#include <octomap/ColorOcTree.h>

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "common/core/error.hpp"

namespace tsg {

/// A picture (CV_8UC3, 1200 x 900) of a map obliquely from above, from where most of it is seen.
/// `tree` has at least one occupied leaf; empty where none of them borders on free space.
[[nodiscard]] cv::Mat picture_of_map(const octomap::ColorOcTree& tree);

/// Draws a map.ot into a PNG, atomically. kMissingInput where the map is absent, kBadData where it
/// is no colour octree, kEmptyInput where nothing in it is occupied, kCannotWrite.
[[nodiscard]] Expected<void> draw_map(const std::filesystem::path& map_ot,
                                      const std::filesystem::path& png);

}  // namespace tsg
