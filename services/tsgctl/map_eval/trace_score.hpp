#pragma once

#include <cstddef>

#include "services/map_server/lib/semantic_octree.hpp"
#include "services/tsgctl/scene_truth/scene_truth.hpp"

namespace tsg {

/// What is wrong with the occupied leaves of an octree, by the truth of the space.
struct TraceScore {
  std::size_t leaves = 0;       ///< occupied
  std::size_t traces = 0;       ///< of these, swept by people and free in truth
  std::size_t off_surface = 0;  ///< of these, free in truth: noise, traces, things that moved

  [[nodiscard]] double trace_share() const { return share(traces); }
  [[nodiscard]] double off_surface_share() const { return share(off_surface); }

 private:
  [[nodiscard]] double share(std::size_t part) const {
    return leaves == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(leaves);
  }
};

/// `octree` must be in the world of the truth. A leaf is free in truth where no surface passes
/// through the voxel of its middle or one beside that: depth is not known better than to a voxel.
[[nodiscard]] TraceScore score_traces(const SemanticOctree& octree, const SceneTruth& truth);

}  // namespace tsg
