#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/core/statistics.hpp"
#include "services/map_server/lib/semantic_map.hpp"
#include "services/tsgctl/map_eval/map_sequence.hpp"
#include "services/tsgctl/map_eval/object_score.hpp"
#include "services/tsgctl/map_eval/trace_score.hpp"

namespace tsg {

struct MapEvalOptions {
  MapSequenceOptions sequence;
  MapConfig map;
  bool exclude = true;  ///< false: people and what moves go into the map like all else
};

/// Points on their way into the cloud, of all keyframes together.
struct PointCounts {
  std::size_t measured = 0;   ///< pixels with a depth
  std::size_t kept = 0;       ///< not of people or what moves, in range, on a surface
  std::size_t in_voxels = 0;  ///< after the voxel filter of each keyframe
  std::size_t stitched = 0;   ///< in the joint cloud, without what is free by now
  std::size_t left = 0;       ///< of these by the outlier filter: what is saved
};

/// Sizes of the files that the map server would write.
struct MapSizes {
  std::size_t cloud = 0;  ///< cloud.ply
  std::size_t ot = 0;     ///< the octree with probabilities and colours
  std::size_t bt = 0;     ///< the same with nothing but occupied and free

  /// How many times as large as the octree of occupied and free the cloud is.
  [[nodiscard]] double cloud_to_octree() const {
    return bt == 0 ? 0.0 : static_cast<double>(cloud) / static_cast<double>(bt);
  }
};

/// What `tsgctl eval map` measures.
struct MapEvalReport {
  std::string sequence;
  std::string poses;
  bool exclude = true;
  std::size_t keyframes = 0;
  PointCounts points;
  MapSizes bytes;
  std::size_t leaves = 0;
  Summary integration_ms;              ///< CPU time of a keyframe, all of it
  std::optional<TraceScore> traces;    ///< absent where the sequence does not tell the truth
  std::optional<ObjectScore> objects;  ///< the same
};

/// An octree file is to be so much smaller than the cloud's: paper, section 6.2 (10.2 MB, 217.8
/// kB).
inline constexpr double kCloudToOctreeTarget = 47.0;
inline constexpr double kTraceShareTarget = 0.005;

/// Builds the map by the code of the map server, and compares it with the truth. `on_progress` is
/// told what is done and how much of it. Throws FatalError: those of plan_keyframes(), kBadData for
/// damaged images or truth, kCannotWrite.
[[nodiscard]] MapEvalReport evaluate_map(
    const MapEvalOptions& options,
    const std::function<void(const char* what, std::size_t done, std::size_t total)>& on_progress);

}  // namespace tsg
