#include "services/slam/lib/pose_finder.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "services/slam/lib/motion_prior.hpp"
#include "services/slam/lib/pnp.hpp"
#include "services/slam/lib/surface_prior.hpp"
#include "services/slam/lib/view_check.hpp"

namespace tsg {
namespace {

constexpr double kPredictedRadius = 8.0;         // pixels: the motion model's usual error
constexpr double kSurpriseRadius = 24.0;         // pixels: when the camera was jerked
constexpr double kMapRadius = 4.0;               // pixels: after a first pose from the last frame
constexpr double kSurfaceRadius = 12.0;          // pixels: after a first pose from the surfaces
constexpr double kKeyframeRadius = 10.0;         // pixels: after a first pose from a keyframe
constexpr int kEnoughMatches = 3;                // times min_inliers; fewer: search on more widely
constexpr std::size_t kKeyframesPerAttempt = 4;  // when lost; bounds the time of a frame
constexpr double kShaky = 0.005;                 // metres or radians: the view leaves much open
constexpr double kHeldShare = 0.7;               // of the inliers, by a pose that motion leads to
constexpr double kChiSquare = 12.6;              // 95 % of 6 degrees of freedom
constexpr double kMaxSigma = 0.02;               // metres or radians: how uncertain a pose may be
constexpr std::int64_t kMaxSurfaceGapNs = 2'000'000'000;
constexpr int kMinCells = 4;               // of 16 that matches must spread over where all was lost
constexpr double kMaxContradiction = 0.2;  // things may have been moved since, a loop may wait

double largest_sigma(const Matrix6d& covariance) {
  return std::sqrt(covariance.diagonal().maxCoeff());
}

/// Whether two estimates of one pose differ by no more than their noise.
bool do_agree(const PoseEstimate& a, const PoseEstimate& b) {
  const Vector6d difference = (a.T_camera_world * b.T_camera_world.inverse()).log();
  const Matrix6d allowed = a.covariance + b.covariance;
  return difference.dot(allowed.ldlt().solve(difference)) < kChiSquare;
}

}  // namespace

std::optional<Fix> PoseFinder::find(const PoseQuery& query, std::optional<Fix> first) {
  if (first && refine(query, *first) && !is_weak(*first)) return first;
  if (auto shaped = by_surface(query); shaped && refine(query, *shaped)) return shaped;
  if (first && first->inliers >= config_.tracker.min_inliers) return first;
  return by_keyframes(query);
}

std::optional<Fix> PoseFinder::find_first(const PoseQuery& query, MatchedClasses classes) const {
  if (query.is_lost || query.last == nullptr) return std::nullopt;
  const FrameSearch search(model_, query.map, query.features, classes);
  const int enough = kEnoughMatches * config_.tracker.min_inliers;
  begin(TrackingStage::kMatch);
  FrameMatches matches = search.match_last_frame(*query.last, LastFramePoints::kMapped,
                                                 query.T_predicted_world, kPredictedRadius);
  if (matches.count() < enough) {
    matches = search.match_last_frame(*query.last, LastFramePoints::kSeenToStay,
                                      query.T_predicted_world, kSurpriseRadius);
  }
  if (matches.count() < config_.tracker.min_inliers && !query.last->doubtful.empty()) {
    matches = search.match_last_frame(*query.last, LastFramePoints::kWithDepth,
                                      query.T_predicted_world, kSurpriseRadius);
  }
  if (matches.count() < config_.tracker.min_inliers) return std::nullopt;
  begin(TrackingStage::kOptimise);
  const PoseEstimate estimate = matches.optimise(model_, query.T_predicted_world);
  if (estimate.inliers < config_.tracker.min_inliers) return std::nullopt;
  return Fix{estimate.T_camera_world, std::move(matches), estimate.inliers, estimate.covariance};
}

/// The pose by the depth images, with what few corners there are.
std::optional<Fix> PoseFinder::by_surface(const PoseQuery& query) const {
  // Later the camera may be anywhere, and rooms are full of shapes that look alike.
  if (query.last == nullptr ||
      query.features.stamp_ns - query.last->features->stamp_ns > kMaxSurfaceGapNs) {
    return std::nullopt;
  }
  begin(TrackingStage::kOptimise);
  const auto prior = pose_by_surface(model_, config_.features, *query.last, query.features,
                                     query.T_predicted_world);
  if (!prior) return std::nullopt;
  begin(TrackingStage::kMatch);
  const FrameSearch search(model_, query.map, query.features);
  FrameMatches matches = search.match_last_frame(*query.last, LastFramePoints::kWithDepth,
                                                 prior->T_camera_world, kSurfaceRadius);
  begin(TrackingStage::kOptimise);
  const PoseEstimate estimate = matches.optimise(model_, prior->T_camera_world, *prior);
  Fix fix{estimate.T_camera_world, std::move(matches), estimate.inliers, estimate.covariance,
          *prior};
  if (!is_certain(fix)) return std::nullopt;
  return fix;
}

/// What mapping recalls of the view; else the reference keyframe, and a few others in turn.
std::vector<const SnapshotKeyframe*> PoseFinder::choose_keyframes(const PoseQuery& query) {
  std::vector<const SnapshotKeyframe*> chosen;
  const auto choose = [&](const SnapshotKeyframe* keyframe) {
    if (keyframe != nullptr) chosen.push_back(keyframe);
  };
  for (const KeyframeId id : query.map.recalled) choose(query.map.find_keyframe(id));
  if (query.last != nullptr) choose(query.map.find_keyframe(query.last->reference));
  const auto& keyframes = query.map.keyframes;
  for (std::size_t i = 0; i < std::min(kKeyframesPerAttempt, keyframes.size()); ++i) {
    const std::size_t back = next_attempt_++ % keyframes.size();
    choose(&keyframes[keyframes.size() - 1 - back]);
  }
  return chosen;
}

std::optional<Fix> PoseFinder::by_keyframes(const PoseQuery& query) {
  for (const SnapshotKeyframe* keyframe : choose_keyframes(query)) {
    auto fix = by_keyframe(query, *keyframe);
    if (!fix || !refine(query, *fix)) continue;
    if (!query.is_lost || is_same_place(query, *keyframe, *fix)) return fix;
  }
  return std::nullopt;
}

std::optional<Fix> PoseFinder::by_keyframe(const PoseQuery& query,
                                           const SnapshotKeyframe& keyframe) const {
  const FrameSearch search(model_, query.map, query.features);
  begin(TrackingStage::kMatch);
  FrameMatches matches = search.match_keyframe(keyframe);
  begin(TrackingStage::kOptimise);
  const int first_inliers = config_.tracker.min_inliers / 2;
  const auto estimate = solve_pnp(model_, matches.to_point_matches(model_), first_inliers);
  if (!estimate) return std::nullopt;
  // Few, but they tell where to look for more.
  const PoseEstimate first = matches.optimise(model_, estimate->T_camera_world);
  begin(TrackingStage::kMatch);
  search.match_local_map(first.T_camera_world, kKeyframeRadius, matches);
  begin(TrackingStage::kOptimise);
  const PoseEstimate refined = matches.optimise(model_, first.T_camera_world);
  if (refined.inliers < config_.tracker.min_inliers) return std::nullopt;
  return Fix{refined.T_camera_world, std::move(matches), refined.inliers, refined.covariance};
}

/// Nothing is known but the view: a thing that stands in two places must not do.
bool PoseFinder::is_same_place(const PoseQuery& query,
                               const SnapshotKeyframe& keyframe,
                               const Fix& fix) const {
  if (cells_with_matches(model_.camera(), fix.matches) < kMinCells) return false;
  const SE3 T_camera_keyframe = fix.T_camera_world * keyframe.T_world_camera;
  return do_surfaces_fit(model_, *keyframe.features, query.features, T_camera_keyframe,
                         kMaxContradiction);
}

bool PoseFinder::refine(const PoseQuery& query, Fix& fix) const {
  fix.T_view_world = fix.T_camera_world;
  fix.view_covariance = fix.covariance;
  if (query.map.keyframes.empty()) return true;  // still on the depth of the first frames
  const FrameSearch search(model_, query.map, query.features);
  begin(TrackingStage::kMatch);
  fix.in_view = search.match_local_map(fix.T_camera_world, kMapRadius, fix.matches);
  // Points of the last frame alone add up its errors: the map does not drift.
  if (fix.matches.mapped() >= kEnoughMatches * config_.tracker.min_inliers) {
    fix.matches.drop_unmapped();
  }
  begin(TrackingStage::kOptimise);
  const FrameMatches all = fix.matches;
  PoseEstimate estimate = by_what_stays(fix);
  fix.T_view_world = estimate.T_camera_world;
  fix.view_covariance = estimate.covariance;
  if (fix.prior.information.isZero() && largest_sigma(estimate.covariance) > kShaky) {
    hold_by_motion(query, all, estimate, fix);
  }
  fix.T_camera_world = estimate.T_camera_world;
  fix.inliers = estimate.inliers;
  fix.covariance = estimate.covariance;
  return is_certain(fix);
}

/// The pose by what cannot move where that is enough to hold it, or where the rest contradicts it:
/// that the rest stands still is known of earlier frames only. What starts to move would take the
/// pose along before it shows. Leaves the matches that were used, without those that do not fit.
PoseEstimate PoseFinder::by_what_stays(Fix& fix) const {
  const int min_inliers = config_.tracker.min_inliers;
  FrameMatches stays = fix.matches.of_static();
  if (stays.count() == fix.matches.count() || stays.mapped() < min_inliers) {
    return fix.matches.optimise(model_, fix.T_camera_world, fix.prior);
  }
  PoseEstimate by_static = stays.optimise(model_, fix.T_camera_world, fix.prior);
  if (by_static.inliers >= kEnoughMatches * min_inliers &&
      largest_sigma(by_static.covariance) <= kShaky) {
    fix.matches.drop_unfit(model_, by_static.T_camera_world);
    by_static.inliers = fix.matches.count();
    return by_static;
  }
  FrameMatches both = fix.matches;
  PoseEstimate by_both = both.optimise(model_, fix.T_camera_world, fix.prior);
  const bool is_contradicted = by_static.inliers >= min_inliers && !do_agree(by_static, by_both);
  fix.matches = is_contradicted ? std::move(stays) : std::move(both);
  return is_contradicted ? by_static : by_both;
}

/// A view that leaves much open is held by the motion until then. `all` are the matches before any
/// was found not to fit.
void PoseFinder::hold_by_motion(const PoseQuery& query,
                                const FrameMatches& all,
                                PoseEstimate& estimate,
                                Fix& fix) const {
  if (query.motion.information.isZero()) return;
  FrameMatches matches = all;
  PoseEstimate held = matches.optimise(model_, query.T_predicted_world, query.motion);
  // Where the camera was jerked, few of them fit a steady motion.
  if (held.inliers < kHeldShare * estimate.inliers) return;
  if (!agrees_with_motion(query.motion, estimate)) {
    fix.T_view_world = held.T_camera_world;
    fix.view_covariance = held.covariance;
  }
  estimate = std::move(held);
  fix.matches = std::move(matches);
}

/// Few matches that leave a freedom besides; few that hold the pose are better than surfaces.
bool PoseFinder::is_weak(const Fix& fix) const {
  const bool few = fix.inliers < kEnoughMatches * config_.tracker.min_inliers;
  return few && !(largest_sigma(fix.covariance) < kMaxSigma);
}

/// Where surfaces hold the pose too, fewer corners do, if together they leave no freedom.
bool PoseFinder::is_certain(const Fix& fix) const {
  if (fix.inliers >= config_.tracker.min_inliers) return true;
  if (fix.prior.information.isZero() || fix.inliers < config_.tracker.min_inliers / 3) return false;
  return largest_sigma(fix.covariance) < kMaxSigma;
}

}  // namespace tsg
