#pragma once

#include <string>
#include <vector>

namespace tsg {

/// How instances become tags.
struct TagConfig {
  double voxel_m = 0.02;         ///< of a tag's cloud; as that of the map
  int max_voxels = 20000;        ///< of one tag; above it its voxels grow to twice the size
  int min_points = 100;          ///< pixels; fewer are a glimpse, or the rim of another instance
  double min_overlap = 0.15;     ///< share of the smaller cloud that must agree, where centres do
  double sure_overlap = 0.4;     ///< the same, where centres do not: a part of something large
  double merge_overlap = 0.5;    ///< two tags that share so much of the smaller are one object
  double min_confidence = 0.6;   ///< of a tag that is reported; two sightings of score 0.75 have it
  int min_observations = 2;      ///< one mask alone may be a mistake
  double gone_share = 0.25;      ///< a tag with less of its place still occupied is gone
  int checks_per_keyframe = 32;  ///< tags whose place is looked at; the others' turn comes later

  [[nodiscard]] std::vector<std::string> problems() const;
};

}  // namespace tsg
