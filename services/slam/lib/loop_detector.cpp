#include "services/slam/lib/loop_detector.hpp"

#include <limits>

#include "services/slam/lib/keyframe_policy.hpp"

namespace tsg {
namespace {

constexpr int kMinLoopMatches = 15;      // by looks; verification asks for more
constexpr std::size_t kMaxVerified = 3;  // candidates per keyframe; bounds the time
constexpr int kHops = 2;                 // in the covisibility graph: so near is no loop
constexpr KeyframeId kRecent = 10;       // keyframes before the newest: no loop either
constexpr int kMaxMisses = 2;            // keyframes in a row that confirm nothing
constexpr double kMaxDisagreementMetres = 0.1;
constexpr double kMaxDisagreementRadians = 0.05;
constexpr double kDriftAllowance = 0.1;  // metres or radians, on top of the share of the path
constexpr double kSceneDepth = 2.0;      // metres, by which views are compared
constexpr double kMaxViewChange = 1.0;   // from further aside features do not match

/// Length of the way that the camera took from one keyframe to another, along those in between.
double path_length(const Map& map, KeyframeId from, KeyframeId to) {
  double metres = 0.0;
  const Keyframe* last = nullptr;
  const MapPart part = map.keyframe(to).part;
  const auto end = map.keyframes().upper_bound(to);
  for (auto place = map.keyframes().find(from); place != end; ++place) {
    const Keyframe& keyframe = place->second;
    if (keyframe.part != part) continue;
    if (last != nullptr) {
      metres += (keyframe.T_world_camera.translation() - last->T_world_camera.translation()).norm();
    }
    last = &keyframe;
  }
  return metres;
}

/// Neighbours of `rim` in the covisibility graph that are not in `known` yet; adds them to it.
std::vector<KeyframeId> neighbours_beyond(const Map& map,
                                          const std::vector<KeyframeId>& rim,
                                          int min_shared_points,
                                          std::unordered_set<KeyframeId>& known) {
  std::vector<KeyframeId> beyond;
  for (const KeyframeId id : rim) {
    for (const Covisibility& neighbour : map.covisible_with(map.keyframe(id))) {
      if (neighbour.shared < min_shared_points) break;
      if (known.insert(neighbour.keyframe).second) beyond.push_back(neighbour.keyframe);
    }
  }
  return beyond;
}

}  // namespace

std::unordered_set<KeyframeId> LoopDetector::connected_with(const Map& map,
                                                            const Keyframe& newest) const {
  std::unordered_set<KeyframeId> connected = {newest.id};
  for (KeyframeId back = 1; back <= kRecent && back <= newest.id; ++back) {
    const auto recent = map.keyframes().find(newest.id - back);
    if (recent != map.keyframes().end() && recent->second.part == newest.part) {
      connected.insert(recent->first);
    }
  }
  std::vector<KeyframeId> rim = {newest.id};
  for (int hop = 0; hop < kHops; ++hop) {
    rim = neighbours_beyond(map, rim, config_.mapper.min_shared_points, connected);
  }
  return connected;
}

std::optional<Loop> LoopDetector::detect(const Map& map,
                                         const PlaceIndex& index,
                                         KeyframeId newest_id) {
  const Keyframe& newest = map.keyframe(newest_id);
  const auto connected = connected_with(map, newest);
  std::optional<VerifiedView> view;
  if (suspicion_) view = follow_up(map, newest, connected);
  if (!view) view = look_up(map, index, newest, connected);
  if (!view) {
    miss();
    return std::nullopt;
  }
  weigh(map, newest, *view);
  if (suspicion_->confirmations < config_.loop.confirmations) return std::nullopt;
  suspicion_.reset();
  const SE3& T_world_before = map.keyframe(view->candidate).T_world_camera;
  return Loop{.newest = newest_id,
              .seen_before = view->candidate,
              .T_before_newest = T_world_before.inverse() * view->T_world_camera,
              .T_world_newest = view->T_world_camera};
}

std::optional<VerifiedView> LoopDetector::look_up(
    const Map& map,
    const PlaceIndex& index,
    const Keyframe& newest,
    const std::unordered_set<KeyframeId>& connected) const {
  const LoopVerifier verifier(model_, config_.loop, map);
  std::size_t verified = 0;
  for (const PlaceCandidate& candidate :
       index.query(*newest.features, connected, kMinLoopMatches)) {
    if (verified++ == kMaxVerified) break;
    auto view = verifier.verify(newest, candidate.keyframe);
    if (view && is_plausible(map, newest, *view)) return view;
  }
  return std::nullopt;
}

/// Looks where the suspicion says that the camera is.
std::optional<VerifiedView> LoopDetector::follow_up(
    const Map& map, const Keyframe& newest, const std::unordered_set<KeyframeId>& connected) const {
  const SE3 T_world_camera = suspicion_->T_corrected_world * newest.T_world_camera;
  const Keyframe* nearest = nullptr;
  double least = kMaxViewChange;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (keyframe.part != suspicion_->part || connected.contains(id)) continue;
    const double change =
        view_change(keyframe.T_world_camera.inverse() * T_world_camera, kSceneDepth);
    if (change >= least) continue;
    least = change;
    nearest = &keyframe;
  }
  if (nearest == nullptr) return std::nullopt;
  const LoopVerifier verifier(model_, config_.loop, map);
  auto view = verifier.verify_near(newest, nearest->id, T_world_camera);
  if (view && !is_plausible(map, newest, *view)) view.reset();
  return view;
}

bool LoopDetector::is_plausible(const Map& map,
                                const Keyframe& newest,
                                const VerifiedView& view) const {
  if (map.keyframe(view.candidate).part != newest.part) return true;
  const double most =
      kDriftAllowance + config_.loop.max_drift_share * path_length(map, view.candidate, newest.id);
  const SE3 T_newest_corrected = newest.T_world_camera.inverse() * view.T_world_camera;
  return T_newest_corrected.translation().norm() <= most && T_newest_corrected.angle() <= most;
}

void LoopDetector::weigh(const Map& map, const Keyframe& newest, const VerifiedView& view) {
  const MapPart part = map.keyframe(view.candidate).part;
  if (suspicion_ && suspicion_->part != part) suspicion_.reset();
  const SE3 T_corrected_world = view.T_world_camera * newest.T_world_camera.inverse();
  if (suspicion_) {
    // Compared at the camera: there the two have to agree, not at the world's far origin.
    const SE3 T_foretold_camera = suspicion_->T_corrected_world * newest.T_world_camera;
    const SE3 difference = T_foretold_camera.inverse() * view.T_world_camera;
    if (difference.translation().norm() > kMaxDisagreementMetres ||
        difference.angle() > kMaxDisagreementRadians) {
      suspicion_.reset();
    }
  }
  const int before = suspicion_ ? suspicion_->confirmations : 0;
  suspicion_ = Suspicion{part, T_corrected_world, before + 1, 0};
}

void LoopDetector::miss() {
  if (suspicion_ && ++suspicion_->misses > kMaxMisses) suspicion_.reset();
}

}  // namespace tsg
