#include "services/map_server/lib/tags/tag_config.hpp"

#include <initializer_list>

namespace tsg {
namespace {

struct Share {
  const char* name;
  double value;
};

}  // namespace

std::vector<std::string> TagConfig::problems() const {
  std::vector<std::string> found;
  if (!(voxel_m >= 0.005 && voxel_m <= 0.2)) {
    found.emplace_back("tags.voxel_m must be 0.005..0.2");
  }
  if (max_voxels < 1000 || max_voxels > 1000000) {
    found.emplace_back("tags.max_voxels must be 1000..1000000");
  }
  if (min_points < 1) found.emplace_back("tags.min_points must be >= 1");
  if (min_observations < 1) found.emplace_back("tags.min_observations must be >= 1");
  if (checks_per_keyframe < 0) found.emplace_back("tags.checks_per_keyframe must be >= 0");
  for (const Share& share : std::initializer_list<Share>{{"min_overlap", min_overlap},
                                                         {"sure_overlap", sure_overlap},
                                                         {"merge_overlap", merge_overlap},
                                                         {"min_confidence", min_confidence},
                                                         {"gone_share", gone_share}}) {
    if (!(share.value > 0.0 && share.value < 1.0)) {
      found.push_back("tags." + std::string(share.name) + " must be > 0 and < 1");
    }
  }
  return found;
}

}  // namespace tsg
