#include "services/tsgctl/map_eval/trace_score.hpp"

namespace tsg {

TraceScore score_traces(const SemanticOctree& octree, const SceneTruth& truth) {
  constexpr int kNearVoxels = 1;
  TraceScore score;
  for (auto leaf = octree.begin_leafs(), end = octree.end_leafs(); leaf != end; ++leaf) {
    if (!octree.isNodeOccupied(*leaf)) continue;
    ++score.leaves;
    const octomap::point3d at = leaf.getCoordinate();
    const Eigen::Vector3f centre(at.x(), at.y(), at.z());
    if (truth.surfaces.has_near(centre, kNearVoxels)) continue;
    ++score.off_surface;
    score.traces += truth.swept_by_people.contains(centre) ? 1 : 0;
  }
  return score;
}

}  // namespace tsg
