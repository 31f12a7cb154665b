#include "services/tsgctl/map_eval/trace_score.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

/// A leaf for each point; seen from (0, 0, 0), along x.
void occupy(SemanticOctree& octree, const std::vector<Eigen::Vector3f>& points) {
  Cloud cloud;
  for (const Eigen::Vector3f& point : points) {
    cloud.push_back({point, {1, 2, 3}, kBackgroundClass, 1});
  }
  octree.integrate(Eigen::Vector3d(0.01, 0.01, 0.01), cloud, {}, ClassTable());
}

TEST(TraceScore, CountsLeavesWhereSomebodyWasAndNothingIs) {
  SceneTruth truth;
  truth.surfaces.insert({2.02F, 0.02F, 0.02F});
  truth.swept_by_people.insert({1.02F, 1.02F, 0.02F});
  truth.swept_by_people.insert({2.07F, 0.02F, 0.02F});  // against the wall
  SemanticOctree octree{OctreeConfig{}};
  occupy(octree, {{2.02F, 0.02F, 0.02F},     // the wall
                  {2.07F, 0.02F, 0.02F},     // a voxel beside it: noise of the wall
                  {1.02F, 1.02F, 0.02F},     // somebody
                  {0.52F, -1.02F, 0.02F}});  // where nobody was
  const TraceScore score = score_traces(octree, truth);
  EXPECT_EQ(score.leaves, 4U);
  EXPECT_EQ(score.traces, 1U);
  EXPECT_EQ(score.off_surface, 2U);
  EXPECT_DOUBLE_EQ(score.trace_share(), 0.25);
  EXPECT_DOUBLE_EQ(score.off_surface_share(), 0.5);
}

TEST(TraceScore, OfAnEmptyMapIsNoTrace) {
  const TraceScore score = score_traces(SemanticOctree{OctreeConfig{}}, SceneTruth{});
  EXPECT_EQ(score.leaves, 0U);
  EXPECT_DOUBLE_EQ(score.trace_share(), 0.0);
}

}  // namespace
}  // namespace tsg
