#pragma once

#include <memory>
#include <vector>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/ids.hpp"

namespace tsg {

/// How often tracking expected to see a map point, and how often it did.
struct PointSighting {
  PointId id = kNoPoint;
  int expected = 0;
  int found = 0;
};

/// A tracked frame that tracking wants in the map. Handed over by value: the pose is relative to
/// a keyframe, as mapping may have moved the map since.
struct KeyframeCandidate {
  KeyframeId id = 0;
  KeyframeId reference = 0;  ///< itself for the first of a part of the map
  SE3 T_reference_camera = {};
  std::shared_ptr<const Features> features;
  std::vector<PointId> points;                ///< per feature: the map point it shows, or kNoPoint
  std::vector<bool> doubtful = {};            ///< per feature: not seen to stand still; empty: none
  std::vector<PointSighting> sightings = {};  ///< since the previous candidate
};

}  // namespace tsg
