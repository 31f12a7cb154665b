#include "services/slam/lib/loop_verifier.hpp"

#include <algorithm>
#include <unordered_set>

#include "services/slam/lib/feature_matcher.hpp"
#include "services/slam/lib/pnp.hpp"
#include "services/slam/lib/point_projection.hpp"
#include "services/slam/lib/view_check.hpp"

namespace tsg {
namespace {

constexpr MatchLimits kLookLimits{.max_distance = 70, .max_ratio = 0.85F};
constexpr MatchLimits kGuidedLimits{.max_distance = 70, .max_ratio = 0.9F};
constexpr int kFirstInliers = 12;      // matches by looks that agree: enough to search on
constexpr double kWideRadius = 12.0;   // pixels: after a first pose by few matches
constexpr double kFarRadius = 30.0;    // pixels: where the pose is foretold
constexpr double kNarrowRadius = 4.0;  // pixels: after a pose by many
constexpr double kLoopGateSigmas = 12.0;
constexpr std::size_t kNeighbours = 10;  // keyframes around the candidate whose points are searched

}  // namespace

FrameMatches LoopVerifier::match_by_looks(const Keyframe& seen, const Keyframe& candidate) const {
  std::vector<bool> usable(candidate.points.size());
  std::transform(candidate.points.begin(), candidate.points.end(), usable.begin(),
                 [](PointId id) { return id != kNoPoint; });
  auto there = match_by_descriptor(*candidate.features, usable, *seen.features, kLookLimits);
  const auto back = match_by_descriptor(*seen.features, std::vector<bool>(seen.points.size(), true),
                                        *candidate.features, kLookLimits);
  std::vector<int> answer(candidate.points.size(), -1);  // feature of `seen`, by candidate's
  for (const FeatureMatch& match : back)
    answer[static_cast<std::size_t>(match.feature)] = match.source;
  std::erase_if(there, [&](const FeatureMatch& match) {
    return answer[static_cast<std::size_t>(match.source)] != match.feature;
  });
  keep_consistent_rotations(there);
  FrameMatches matches(*seen.features);
  for (const FeatureMatch& match : there) {
    const PointId id = candidate.points[static_cast<std::size_t>(match.source)];
    matches.assign(match.feature, id, map_.find_point(id)->position);
  }
  return matches;
}

void LoopVerifier::match_neighbourhood(const Keyframe& candidate,
                                       const SE3& T_world_camera,
                                       double radius_px,
                                       FrameMatches& matches) const {
  std::vector<const Keyframe*> keyframes = {&candidate};
  for (const Covisibility& neighbour : map_.covisible_with(candidate)) {
    if (keyframes.size() > kNeighbours) break;
    keyframes.push_back(&map_.keyframe(neighbour.keyframe));
  }
  const ProjectionSearch search{.T_camera_world = T_world_camera.inverse(),
                                .radius = radius_px,
                                .depth_gate_sigmas = kLoopGateSigmas};
  const std::vector<PointId> before = matches.points();
  std::unordered_set<PointId> known(before.begin(), before.end());
  std::vector<const MapPoint*> points;
  std::vector<MatchTarget> targets;
  for (const Keyframe* keyframe : keyframes) {
    for (const PointId id : keyframe->points) {
      if (id == kNoPoint || !known.insert(id).second) continue;
      const MapPoint& point = *map_.find_point(id);
      auto target = project_point(model_, search, appearance_of(point));
      if (!target) continue;
      target->source = static_cast<int>(points.size());
      points.push_back(&point);
      targets.push_back(*target);
    }
  }
  for (const FeatureMatch& match :
       match_by_projection(matches.features(), targets, matches.taken(), kGuidedLimits)) {
    const MapPoint& point = *points[static_cast<std::size_t>(match.source)];
    matches.assign(match.feature, point.id, point.position);
  }
}

std::optional<VerifiedView> LoopVerifier::verify(const Keyframe& seen,
                                                 KeyframeId candidate_id) const {
  const Keyframe& candidate = map_.keyframe(candidate_id);
  FrameMatches matches = match_by_looks(seen, candidate);
  const auto by_looks = solve_pnp(model_, matches.to_point_matches(model_), kFirstInliers);
  if (!by_looks) return std::nullopt;
  PoseEstimate estimate = matches.optimise(model_, by_looks->T_camera_world);
  match_neighbourhood(candidate, estimate.T_camera_world.inverse(), kWideRadius, matches);
  estimate = matches.optimise(model_, estimate.T_camera_world);
  match_neighbourhood(candidate, estimate.T_camera_world.inverse(), kNarrowRadius, matches);
  estimate = matches.optimise(model_, estimate.T_camera_world);
  return judge(seen, candidate, estimate.T_camera_world.inverse(), matches);
}

std::optional<VerifiedView> LoopVerifier::verify_near(const Keyframe& seen,
                                                      KeyframeId candidate_id,
                                                      const SE3& T_world_camera) const {
  const Keyframe& candidate = map_.keyframe(candidate_id);
  FrameMatches matches(*seen.features);
  match_neighbourhood(candidate, T_world_camera, kFarRadius, matches);
  PoseEstimate estimate = matches.optimise(model_, T_world_camera.inverse());
  match_neighbourhood(candidate, estimate.T_camera_world.inverse(), kNarrowRadius, matches);
  estimate = matches.optimise(model_, estimate.T_camera_world);
  return judge(seen, candidate, estimate.T_camera_world.inverse(), matches);
}

std::optional<VerifiedView> LoopVerifier::judge(const Keyframe& seen,
                                                const Keyframe& candidate,
                                                const SE3& T_world_camera,
                                                const FrameMatches& matches) const {
  const int inliers = matches.count();
  if (inliers < config_.min_inliers) return std::nullopt;
  if (cells_with_matches(model_.camera(), matches) < config_.min_cells) return std::nullopt;
  const SE3 T_candidate_seen = candidate.T_world_camera.inverse() * T_world_camera;
  if (!do_surfaces_fit(model_, *seen.features, *candidate.features, T_candidate_seen,
                       config_.max_contradiction)) {
    return std::nullopt;
  }
  return VerifiedView{candidate.id, T_world_camera, inliers};
}

}  // namespace tsg
