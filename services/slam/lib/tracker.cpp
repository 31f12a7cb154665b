#include "services/slam/lib/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "services/slam/lib/dynamic_filter.hpp"
#include "services/slam/lib/feature_extractor.hpp"
#include "services/slam/lib/frame_search.hpp"
#include "services/slam/lib/keyframe_policy.hpp"
#include "services/slam/lib/observation_model.hpp"
#include "services/slam/lib/pnp.hpp"
#include "services/slam/lib/surface_prior.hpp"

namespace tsg {
namespace {

constexpr double kPredictedRadius = 8.0;         // pixels: the motion model's usual error
constexpr double kSurpriseRadius = 24.0;         // pixels: when the camera was jerked
constexpr double kMapRadius = 4.0;               // pixels: after a first pose from the last frame
constexpr double kSurfaceRadius = 12.0;          // pixels: after a first pose from the surfaces
constexpr double kKeyframeRadius = 10.0;         // pixels: after a first pose from a keyframe
constexpr int kEnoughMatches = 3;                // times min_inliers; fewer: search on more widely
constexpr std::size_t kKeyframesPerAttempt = 4;  // when lost; bounds the time of a frame
constexpr double kMaxSigma = 0.02;               // metres or radians: how uncertain a pose may be
constexpr std::int64_t kMaxSurfaceGapNs = 2'000'000'000;
constexpr int kEstablished = 2;        // observations of a point that is no mere candidate
constexpr double kDefaultDepth = 2.0;  // metres, of a scene without any depth

/// A pose with the matches that it rests on.
struct Fix {
  SE3 T_camera_world;
  FrameMatches matches;
  int inliers = 0;
  PosePrior prior = {};  ///< by the shape of the scene; without weight where that was not asked
};

double median_depth(const Features& features) {
  std::vector<float> inverse_depths;
  for (const Feature& feature : features.items) {
    if (feature.has_depth()) inverse_depths.push_back(feature.inverse_depth);
  }
  if (inverse_depths.empty()) return kDefaultDepth;
  const auto middle =
      inverse_depths.begin() + static_cast<std::ptrdiff_t>(inverse_depths.size() / 2);
  std::nth_element(inverse_depths.begin(), middle, inverse_depths.end());
  return 1.0 / *middle;
}

}  // namespace

struct Tracker::Impl {
  Impl(const SlamConfig& slam_config,
       const CameraModel& camera,
       std::function<void(TrackingStage)> stage_listener)
      : config(slam_config),
        model(camera, slam_config),
        extractor(slam_config.features, camera),
        filter(slam_config.dynamic_filter, camera),
        on_stage(std::move(stage_listener)) {}

  void begin(TrackingStage stage) const {
    if (on_stage) on_stage(stage);
  }
  void start_map(const std::shared_ptr<const Features>& features, TrackResult& result);
  void follow_map(const LocalMapSnapshot& map);
  [[nodiscard]] SE3 predict(std::int64_t stamp_ns) const;

  [[nodiscard]] std::optional<Fix> fix_by_last_frame(const FrameSearch& search,
                                                     std::int64_t stamp_ns) const;
  [[nodiscard]] std::optional<Fix> fix_by_surface(const FrameSearch& search,
                                                  const Features& features) const;
  [[nodiscard]] std::optional<Fix> fix_by_keyframes(const FrameSearch& search,
                                                    const LocalMapSnapshot& map);
  [[nodiscard]] std::optional<Fix> fix_by_keyframe(const FrameSearch& search,
                                                   const SnapshotKeyframe& keyframe) const;
  [[nodiscard]] std::optional<Fix> find_fix(const Features& features, const LocalMapSnapshot& map);
  bool refine(const FrameSearch& search, const LocalMapSnapshot& map, Fix& fix);
  [[nodiscard]] bool is_weak(const Fix& fix) const;
  [[nodiscard]] bool is_certain(const Fix& fix, const PoseEstimate& estimate) const;
  void count_sightings(const std::vector<PointId>& in_view, const FrameMatches& matches);

  void accept(const std::shared_ptr<const Features>& features,
              const LocalMapSnapshot& map,
              const Fix& fix,
              TrackResult& result);
  void lose(TrackResult& result, std::string reason);
  [[nodiscard]] KeyframeId choose_reference(const LocalMapSnapshot& map,
                                            const FrameMatches& matches) const;
  void propose_keyframe(const LocalMapSnapshot& map, int inliers, TrackResult& result);
  [[nodiscard]] KeyframeCandidate make_candidate();

  SlamConfig config;
  ObservationModel model;
  FeatureExtractor extractor;
  DynamicFilter filter;
  std::function<void(TrackingStage)> on_stage;

  bool started = false;
  bool lost = false;
  std::optional<TrackedFrame> last;
  Vector6d twist_per_second = Vector6d::Zero();  ///< log of T_last_now for one second
  KeyframeId next_keyframe = 0;
  std::size_t next_attempt = 0;  ///< keyframe that relocalisation tries next
  std::map<PointId, PointSighting> sightings;
};

void Tracker::Impl::start_map(const std::shared_ptr<const Features>& features,
                              TrackResult& result) {
  if (features->counts.with_depth < config.tracker.min_features_to_start) {
    result.reason = "too few features with depth: " + std::to_string(features->counts.with_depth) +
                    ", needs " + std::to_string(config.tracker.min_features_to_start);
    return;
  }
  started = true;
  last = TrackedFrame{.features = features,
                      .points = std::vector<PointId>(features->size(), kNoPoint),
                      .reference = next_keyframe,
                      .T_reference_camera = SE3(),
                      .T_world_camera = SE3()};
  result.state = TrackingState::kTracking;
  result.T_world_camera = SE3();
  result.reference = next_keyframe;
  filter.note_pose(features->seq, SE3());
  result.keyframe = make_candidate();
}

/// Brings the last pose to where mapping has moved its keyframe since.
void Tracker::Impl::follow_map(const LocalMapSnapshot& map) {
  const SnapshotKeyframe* reference = map.find_keyframe(last->reference);
  if (reference != nullptr) {
    last->T_world_camera = reference->T_world_camera * last->T_reference_camera;
  }
}

SE3 Tracker::Impl::predict(std::int64_t stamp_ns) const {
  if (!last || lost) return last ? last->T_world_camera : SE3();
  const double seconds = static_cast<double>(stamp_ns - last->features->stamp_ns) * 1e-9;
  return last->T_world_camera * SE3::exp(twist_per_second * seconds);
}

std::optional<Fix> Tracker::Impl::fix_by_last_frame(const FrameSearch& search,
                                                    std::int64_t stamp_ns) const {
  const SE3 T_camera_world = predict(stamp_ns).inverse();
  const int enough = kEnoughMatches * config.tracker.min_inliers;
  begin(TrackingStage::kMatch);
  FrameMatches matches =
      search.match_last_frame(*last, LastFramePoints::kMapped, T_camera_world, kPredictedRadius);
  if (matches.count() < enough) {
    matches = search.match_last_frame(*last, LastFramePoints::kWithDepth, T_camera_world,
                                      kSurpriseRadius);
  }
  if (matches.count() < config.tracker.min_inliers) return std::nullopt;
  begin(TrackingStage::kOptimise);
  const PoseEstimate estimate = matches.optimise(model, T_camera_world);
  if (estimate.inliers < config.tracker.min_inliers) return std::nullopt;
  return Fix{estimate.T_camera_world, std::move(matches), estimate.inliers};
}

std::optional<Fix> Tracker::Impl::fix_by_keyframe(const FrameSearch& search,
                                                  const SnapshotKeyframe& keyframe) const {
  begin(TrackingStage::kMatch);
  FrameMatches matches = search.match_keyframe(keyframe);
  begin(TrackingStage::kOptimise);
  const int first_inliers = config.tracker.min_inliers / 2;
  const auto estimate = solve_pnp(model, matches.to_point_matches(model), first_inliers);
  if (!estimate) return std::nullopt;
  // Few, but they tell where to look for more.
  const PoseEstimate first = matches.optimise(model, estimate->T_camera_world);
  begin(TrackingStage::kMatch);
  search.match_local_map(first.T_camera_world, kKeyframeRadius, matches);
  begin(TrackingStage::kOptimise);
  const PoseEstimate refined = matches.optimise(model, first.T_camera_world);
  if (refined.inliers < config.tracker.min_inliers) return std::nullopt;
  return Fix{refined.T_camera_world, std::move(matches), refined.inliers};
}

/// The pose by the depth images, with what few corners there are.
std::optional<Fix> Tracker::Impl::fix_by_surface(const FrameSearch& search,
                                                 const Features& features) const {
  // Later the camera may be anywhere, and rooms are full of shapes that look alike.
  if (features.stamp_ns - last->features->stamp_ns > kMaxSurfaceGapNs) return std::nullopt;
  begin(TrackingStage::kOptimise);
  const SE3 T_predicted = predict(features.stamp_ns).inverse();
  const auto prior = pose_by_surface(model, config.features, *last, features, T_predicted);
  if (!prior) return std::nullopt;
  begin(TrackingStage::kMatch);
  FrameMatches matches = search.match_last_frame(*last, LastFramePoints::kWithDepth,
                                                 prior->T_camera_world, kSurfaceRadius);
  begin(TrackingStage::kOptimise);
  const PoseEstimate estimate = matches.optimise(model, prior->T_camera_world, *prior);
  Fix fix{estimate.T_camera_world, std::move(matches), estimate.inliers, *prior};
  if (!is_certain(fix, estimate)) return std::nullopt;
  return fix;
}

/// Tries the reference keyframe first, then, a few per frame, all that the snapshot has.
std::optional<Fix> Tracker::Impl::fix_by_keyframes(const FrameSearch& search,
                                                   const LocalMapSnapshot& map) {
  if (map.keyframes.empty()) return std::nullopt;
  if (const SnapshotKeyframe* reference = map.find_keyframe(last->reference)) {
    if (auto fix = fix_by_keyframe(search, *reference)) return fix;
  }
  const std::size_t attempts = std::min(kKeyframesPerAttempt, map.keyframes.size());
  for (std::size_t i = 0; i < attempts; ++i) {
    const std::size_t back = next_attempt++ % map.keyframes.size();
    const SnapshotKeyframe& keyframe = map.keyframes[map.keyframes.size() - 1 - back];
    if (auto fix = fix_by_keyframe(search, keyframe)) return fix;
  }
  return std::nullopt;
}

bool Tracker::Impl::refine(const FrameSearch& search, const LocalMapSnapshot& map, Fix& fix) {
  if (map.keyframes.empty()) return true;  // still on the depth of the first frames
  begin(TrackingStage::kMatch);
  const auto in_view = search.match_local_map(fix.T_camera_world, kMapRadius, fix.matches);
  // Points of the last frame alone add up its errors: the map does not drift.
  if (fix.matches.mapped() >= kEnoughMatches * config.tracker.min_inliers) {
    fix.matches.drop_unmapped();
  }
  begin(TrackingStage::kOptimise);
  const PoseEstimate estimate = fix.matches.optimise(model, fix.T_camera_world, fix.prior);
  fix.T_camera_world = estimate.T_camera_world;
  fix.inliers = estimate.inliers;
  if (!is_certain(fix, estimate)) return false;
  count_sightings(in_view, fix.matches);
  return true;
}

bool Tracker::Impl::is_weak(const Fix& fix) const {
  return fix.inliers < kEnoughMatches * config.tracker.min_inliers;
}

/// Where surfaces hold the pose too, fewer corners do, if together they leave no freedom.
bool Tracker::Impl::is_certain(const Fix& fix, const PoseEstimate& estimate) const {
  if (fix.inliers >= config.tracker.min_inliers) return true;
  if (fix.prior.information.isZero() || fix.inliers < config.tracker.min_inliers / 3) return false;
  return estimate.covariance.diagonal().maxCoeff() < kMaxSigma * kMaxSigma;
}

/// Each way in turn, the cheap ones first; the first pose that the map confirms.
std::optional<Fix> Tracker::Impl::find_fix(const Features& features, const LocalMapSnapshot& map) {
  const FrameSearch search(model, map, features);
  std::optional<Fix> fix;
  if (!lost) fix = fix_by_last_frame(search, features.stamp_ns);
  if (fix && refine(search, map, *fix) && !is_weak(*fix)) return fix;
  if (auto by_surface = fix_by_surface(search, features)) {
    if (refine(search, map, *by_surface)) return by_surface;
  }
  if (fix && fix->inliers >= config.tracker.min_inliers) return fix;
  fix = fix_by_keyframes(search, map);
  if (fix && refine(search, map, *fix)) return fix;
  return std::nullopt;
}

void Tracker::Impl::count_sightings(const std::vector<PointId>& in_view,
                                    const FrameMatches& matches) {
  for (const PointId id : in_view) {
    PointSighting& sighting = sightings[id];
    sighting.id = id;
    ++sighting.expected;
  }
  for (const PointId id : matches.points()) {
    if (id == kNoPoint) continue;
    PointSighting& sighting = sightings[id];
    sighting.id = id;
    ++sighting.found;
  }
}

void Tracker::Impl::accept(const std::shared_ptr<const Features>& features,
                           const LocalMapSnapshot& map,
                           const Fix& fix,
                           TrackResult& result) {
  begin(TrackingStage::kDecide);
  TrackedFrame now{.features = features,
                   .points = fix.matches.points(),
                   .T_world_camera = fix.T_camera_world.inverse()};
  now.reference = choose_reference(map, fix.matches);
  const SnapshotKeyframe* reference = map.find_keyframe(now.reference);
  // Before the first snapshot the first keyframe is where the world is.
  const SE3 T_world_reference = reference == nullptr ? SE3() : reference->T_world_camera;
  now.T_reference_camera = T_world_reference.inverse() * now.T_world_camera;
  const double seconds = static_cast<double>(features->stamp_ns - last->features->stamp_ns) * 1e-9;
  twist_per_second = Vector6d::Zero();
  if (!lost && seconds > 0.0) {
    twist_per_second = (last->T_world_camera.inverse() * now.T_world_camera).log() / seconds;
  }
  result.relocalised = lost;
  lost = false;
  last = std::move(now);
  filter.note_pose(features->seq, last->T_world_camera);
  result.state = TrackingState::kTracking;
  result.T_world_camera = last->T_world_camera;
  result.reference = last->reference;
  result.T_reference_camera = last->T_reference_camera;
  result.inliers = fix.inliers;
  propose_keyframe(map, fix.inliers, result);
}

void Tracker::Impl::lose(TrackResult& result, std::string reason) {
  lost = true;
  result.state = TrackingState::kLost;
  result.reason = std::move(reason);
}

KeyframeId Tracker::Impl::choose_reference(const LocalMapSnapshot& map,
                                           const FrameMatches& matches) const {
  std::vector<PointId> seen = matches.points();
  std::sort(seen.begin(), seen.end());
  KeyframeId best = last->reference;
  std::ptrdiff_t most = 0;
  for (const SnapshotKeyframe& keyframe : map.keyframes) {
    const auto shared =
        std::count_if(keyframe.points.begin(), keyframe.points.end(), [&](PointId id) {
          return id != kNoPoint && std::binary_search(seen.begin(), seen.end(), id);
        });
    if (shared <= most) continue;
    most = shared;
    best = keyframe.id;
  }
  return best;
}

void Tracker::Impl::propose_keyframe(const LocalMapSnapshot& map,
                                     int inliers,
                                     TrackResult& result) {
  const bool last_is_mapped = !map.keyframes.empty() && map.newest + 1 == next_keyframe;
  const SnapshotKeyframe* reference = map.find_keyframe(last->reference);
  if (!last_is_mapped || reference == nullptr) return;
  const double depth = median_depth(*last->features);
  KeyframeEvidence evidence{.nearest_view_change = std::numeric_limits<double>::max(),
                            .map_inliers = inliers};
  for (const SnapshotKeyframe& keyframe : map.keyframes) {
    const SE3 T_keyframe_camera = keyframe.T_world_camera.inverse() * last->T_world_camera;
    evidence.nearest_view_change =
        std::min(evidence.nearest_view_change, view_change(T_keyframe_camera, depth));
  }
  const int established = map.keyframes.size() > kEstablished ? kEstablished : 1;
  for (const PointId id : reference->points) {
    const SnapshotPoint* point = id == kNoPoint ? nullptr : map.find_point(id);
    if (point != nullptr && point->observations >= established) ++evidence.reference_points;
  }
  if (is_worth_a_keyframe(evidence, config.tracker)) result.keyframe = make_candidate();
}

KeyframeCandidate Tracker::Impl::make_candidate() {
  KeyframeCandidate candidate{.id = next_keyframe++,
                              .reference = last->reference,
                              .T_reference_camera = last->T_reference_camera,
                              .features = last->features,
                              .points = last->points};
  candidate.sightings.reserve(sightings.size());
  for (const auto& [id, sighting] : sightings) candidate.sightings.push_back(sighting);
  sightings.clear();
  return candidate;
}

Tracker::Tracker(const SlamConfig& config,
                 const CameraModel& camera,
                 std::function<void(TrackingStage)> on_stage)
    : impl_(std::make_unique<Impl>(config, camera, std::move(on_stage))) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

std::shared_ptr<const Features> Tracker::extract(const RgbdFrame& frame,
                                                 const InstanceSegmentation* mask) {
  const cv::Mat verdicts = impl_->filter.judge(frame, mask, impl_->predict(frame.stamp_ns));
  Features features = impl_->extractor.extract(frame, verdicts);
  if (!verdicts.empty()) {
    features.mask_age_frames = static_cast<int>(frame.seq - mask->frame_seq);
  }
  return std::make_shared<const Features>(std::move(features));
}

TrackResult Tracker::track(const std::shared_ptr<const Features>& features,
                           const LocalMapSnapshot& map) {
  TrackResult result{.seq = features->seq,
                     .stamp_ns = features->stamp_ns,
                     .features = features->counts,
                     .mask_age_frames = features->mask_age_frames};
  if (!impl_->started) {
    impl_->start_map(features, result);
    return result;
  }
  impl_->follow_map(map);
  const std::optional<Fix> fix = impl_->find_fix(*features, map);
  if (!fix) {
    impl_->lose(result, "neither the last frame nor a keyframe matches the view");
    return result;
  }
  result.matches = fix->matches.count();
  impl_->accept(features, map, *fix, result);
  if (impl_->filter.has_new_mask()) {
    for (const SnapshotPoint& point : map.points) {
      if (impl_->filter.was_dynamic(point.position)) result.dynamic_points.push_back(point.id);
    }
  }
  return result;
}

}  // namespace tsg
