#include "services/slam/lib/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "common/core/time.hpp"
#include "services/slam/lib/dynamic/dynamic_filter.hpp"
#include "services/slam/lib/dynamic/static_features.hpp"
#include "services/slam/lib/feature_extractor.hpp"
#include "services/slam/lib/keyframe_policy.hpp"
#include "services/slam/lib/motion_prior.hpp"
#include "services/slam/lib/observation_model.hpp"
#include "services/slam/lib/pose_finder.hpp"

namespace tsg {
namespace {

/// Sorted by id: a hash table has no order that could be repeated.
std::vector<PointSighting> sorted(const std::unordered_map<PointId, PointSighting>& sightings) {
  std::vector<PointSighting> list;
  list.reserve(sightings.size());
  for (const auto& [id, sighting] : sightings) list.push_back(sighting);
  std::ranges::sort(list, {}, &PointSighting::id);
  return list;
}

std::shared_ptr<const FrameVerdicts> report(const Features& features,
                                            const std::vector<cv::Point>& left_out,
                                            Judgement judgement) {
  FrameVerdicts verdicts;
  verdicts.features.reserve(features.size() + left_out.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Feature& feature = features.items[i];
    verdicts.features.push_back(
        {.raw_x = feature.raw_x,
         .raw_y = feature.raw_y,
         .prior = feature.verdict,
         .is_dynamic = !judgement.is_dynamic.empty() && judgement.is_dynamic[i],
         .epipolar_px = judgement.epipolar_px.empty() ? -1.0F : judgement.epipolar_px[i]});
  }
  for (const cv::Point& pixel : left_out) {
    verdicts.features.push_back({.raw_x = static_cast<std::int16_t>(pixel.x),
                                 .raw_y = static_cast<std::int16_t>(pixel.y),
                                 .prior = FeatureVerdict::kDynamic,
                                 .is_dynamic = true});
  }
  verdicts.instances = std::move(judgement.instances);
  return std::make_shared<const FrameVerdicts>(std::move(verdicts));
}

}  // namespace

/// What is known of a frame before the map is asked.
struct FirstLook {
  std::shared_ptr<const Features> features;  ///< without those that move
  std::vector<bool> doubtful;                ///< of these: not seen to stand still; empty: none
  std::optional<Fix> fix;                    ///< by the last frame alone
};

struct Tracker::Impl {
  Impl(const SlamConfig& slam_config,
       const CameraModel& camera,
       std::function<void(TrackingStage)> stage_listener)
      : config(slam_config),
        model(camera, slam_config),
        extractor(slam_config.features, camera),
        filter(slam_config, model),
        on_stage(std::move(stage_listener)),
        finder(config, model, on_stage) {}

  void start_map(const std::shared_ptr<const Features>& features, TrackResult& result);
  void enter_map(const LocalMapSnapshot& map, std::int64_t stamp_ns);
  [[nodiscard]] const LocalMapSnapshot& follow_part(const LocalMapSnapshot& map);
  [[nodiscard]] bool is_lost_for_long(std::int64_t stamp_ns) const;
  void follow_map(const LocalMapSnapshot& map);
  [[nodiscard]] SE3 predict(std::int64_t stamp_ns) const;
  [[nodiscard]] PoseQuery query(const Features& features, const LocalMapSnapshot& map) const;
  [[nodiscard]] FirstLook look(const std::shared_ptr<const Features>& features,
                               const LocalMapSnapshot& map,
                               TrackResult& result);

  void count_sightings(const Fix& fix);

  void accept(const FirstLook& first,
              const LocalMapSnapshot& map,
              const Fix& fix,
              TrackResult& result);
  [[nodiscard]] std::string why_lost() const;
  void lose(TrackResult& result, std::string reason);
  void begin_part(const std::shared_ptr<const Features>& features, TrackResult& result);
  void propose_keyframe(const LocalMapSnapshot& map, int inliers, TrackResult& result);
  [[nodiscard]] KeyframeCandidate make_candidate();

  SlamConfig config;
  ObservationModel model;
  FeatureExtractor extractor;
  DynamicFilter filter;
  std::function<void(TrackingStage)> on_stage;
  PoseFinder finder;

  bool started = false;
  bool lost = false;
  std::int64_t lost_since_ns = 0;
  MapPart part = 0;  ///< that `last` is in
  std::optional<TrackedFrame> last;
  CameraMotion motion;  ///< until `last`
  KeyframeId next_keyframe = 0;
  std::uint64_t corrections = 0;  ///< of the map that `last` is in
  std::unordered_map<PointId, PointSighting> sightings;
};

void Tracker::Impl::start_map(const std::shared_ptr<const Features>& features,
                              TrackResult& result) {
  if (features->counts.with_depth < config.tracker.min_features_to_start) {
    result.reason = "too few features with depth: " + std::to_string(features->counts.with_depth) +
                    ", needs " + std::to_string(config.tracker.min_features_to_start);
    return;
  }
  started = true;
  part = part_begun_by(next_keyframe);
  last = TrackedFrame{.features = features,
                      .points = std::vector<PointId>(features->size(), kNoPoint),
                      .reference = next_keyframe,
                      .T_reference_camera = SE3(),
                      .T_world_camera = SE3()};
  result.state = TrackingState::kTracking;
  result.T_world_camera = SE3();
  result.part = part;
  result.reference = next_keyframe;
  filter.note_pose(SE3());
  motion.start(SE3(), Matrix6d::Zero());
  result.keyframe = make_candidate();
}

/// The map was there before the camera: it is lost in it.
void Tracker::Impl::enter_map(const LocalMapSnapshot& map, std::int64_t stamp_ns) {
  started = true;
  lost = true;
  lost_since_ns = stamp_ns;
  next_keyframe = map.newest + 1;
  corrections = map.corrections;
}

/// What of the map has the world that `last` is in. Nothing has while mapping does not know of a
/// part that was just begun; and where it has become a part of another, that is the world now.
const LocalMapSnapshot& Tracker::Impl::follow_part(const LocalMapSnapshot& map) {
  static const LocalMapSnapshot kNothing;
  if (lost || map.keyframes.empty() || map.part == part) return map;
  if (map.find_keyframe(last->reference) != nullptr) {
    part = map.part;
    return map;
  }
  if (part_begun_by(last->reference) == part) return kNothing;
  lost = true;  // among places that were never tracked from here
  lost_since_ns = last->features->stamp_ns;
  return map;
}

bool Tracker::Impl::is_lost_for_long(std::int64_t stamp_ns) const {
  const double limit_s = config.tracker.new_part_after_s;
  if (limit_s <= 0.0 || config.tracker.localisation_only) return false;
  return static_cast<double>(stamp_ns - lost_since_ns) * 1e-9 >= limit_s;
}

/// Where nothing that is known can be found again, mapping goes on all the same.
void Tracker::Impl::begin_part(const std::shared_ptr<const Features>& features,
                               TrackResult& result) {
  if (features->counts.with_depth < config.tracker.min_features_to_start) return;
  filter.leave_world();
  sightings.clear();
  start_map(features, result);
  result.reason.clear();
  result.relocalised = true;
  lost = false;
}

/// Brings the last pose to where mapping has moved its keyframe since.
void Tracker::Impl::follow_map(const LocalMapSnapshot& map) {
  if (!last) return;
  const SnapshotKeyframe* reference = map.find_keyframe(last->reference);
  if (reference == nullptr) return;
  const SE3 T_world_before = last->T_world_camera;
  last->T_world_camera = reference->T_world_camera * last->T_reference_camera;
  motion.move_world(last->T_world_camera * T_world_before.inverse());
  if (map.corrections == corrections) return;
  corrections = map.corrections;
  filter.move_world(last->T_world_camera * T_world_before.inverse());
}

SE3 Tracker::Impl::predict(std::int64_t stamp_ns) const {
  if (!last || lost) return last ? last->T_world_camera : SE3();
  const double seconds = to_seconds(stamp_ns - last->features->stamp_ns);
  return motion.predict(seconds).T_camera_world.inverse();
}

PoseQuery Tracker::Impl::query(const Features& features, const LocalMapSnapshot& map) const {
  PoseQuery query{.features = features,
                  .map = map,
                  .last = last ? &*last : nullptr,
                  .T_predicted_world = predict(features.stamp_ns).inverse(),
                  .is_lost = lost};
  if (last && !lost) {
    query.motion = motion.predict(to_seconds(features.stamp_ns - last->features->stamp_ns));
  }
  return query;
}

/// A pose by what never moves, then what moves by that pose (paper, section 4.3).
FirstLook Tracker::Impl::look(const std::shared_ptr<const Features>& features,
                              const LocalMapSnapshot& map,
                              TrackResult& result) {
  FirstLook first{.features = features, .doubtful = {}, .fix = std::nullopt};
  const bool needs_pose = config.dynamic_filter.method == DynamicMethod::kFull;
  if (needs_pose) {
    first.fix = finder.find_first(query(*features, map), MatchedClasses::kStatic);
    if (!first.fix) first.fix = finder.find_first(query(*features, map), MatchedClasses::kAll);
  }
  const SE3 T_world_camera = first.fix ? first.fix->T_camera_world.inverse() : SE3();
  Judgement judgement = filter.judge_by_motion(*features, first.fix ? &T_world_camera : nullptr);
  StaticFeatures kept = keep_static(features, judgement, model.camera());
  first.features = kept.features;
  first.doubtful = std::move(kept.doubtful);
  result.features = first.features->counts;
  result.verdicts = report(*features, extractor.left_out(), std::move(judgement));
  if (first.fix) first.fix->matches = first.fix->matches.onto(*kept.features, kept.new_index);
  if (!needs_pose) first.fix = finder.find_first(query(*kept.features, map), MatchedClasses::kAll);
  return first;
}

void Tracker::Impl::count_sightings(const Fix& fix) {
  if (config.tracker.localisation_only) return;  // nobody would ever take them
  const auto of = [this](PointId id) -> PointSighting& {
    return sightings.try_emplace(id, PointSighting{.id = id}).first->second;
  };
  for (const PointId id : fix.in_view) ++of(id).expected;
  for (const PointId id : fix.matches.points()) {
    if (id != kNoPoint) ++of(id).found;
  }
}

void Tracker::Impl::accept(const FirstLook& first,
                           const LocalMapSnapshot& map,
                           const Fix& fix,
                           TrackResult& result) {
  if (on_stage) on_stage(TrackingStage::kDecide);
  count_sightings(fix);
  const std::int64_t stamp_ns = first.features->stamp_ns;
  TrackedFrame now{.features = first.features,
                   .points = fix.matches.points(),
                   .doubtful = first.doubtful,
                   .T_world_camera = fix.T_camera_world.inverse()};
  now.reference =
      map.keyframe_sharing_most(now.points).value_or(last ? last->reference : map.newest);
  const SnapshotKeyframe* reference = map.find_keyframe(now.reference);
  // Before the first snapshot the first keyframe is where the world is.
  const SE3 T_world_reference = reference == nullptr ? SE3() : reference->T_world_camera;
  now.T_reference_camera = T_world_reference.inverse() * now.T_world_camera;
  if (lost) {
    motion.start(fix.T_camera_world, fix.covariance);
  } else {
    result.T_previous_camera = last->T_world_camera.inverse() * now.T_world_camera;
    motion.add(fix.T_view_world, fix.view_covariance,
               to_seconds(stamp_ns - last->features->stamp_ns));
  }
  result.relocalised = lost;
  lost = false;
  if (!map.keyframes.empty()) part = map.part;
  last = std::move(now);
  filter.note_pose(last->T_world_camera);
  result.state = TrackingState::kTracking;
  result.T_world_camera = last->T_world_camera;
  result.part = part;
  result.reference = last->reference;
  result.T_reference_camera = last->T_reference_camera;
  result.inliers = fix.inliers;
  result.covariance = fix.covariance;
  propose_keyframe(map, fix.inliers, result);
}

std::string Tracker::Impl::why_lost() const {
  if (!last) return "looking for the place in the loaded map";
  if (config.tracker.localisation_only) return "no place of the map (localisation only) matches";
  return "neither the last frame nor a keyframe matches the view";
}

void Tracker::Impl::lose(TrackResult& result, std::string reason) {
  if (!lost) lost_since_ns = result.stamp_ns;
  lost = true;
  result.state = TrackingState::kLost;
  result.reason = std::move(reason);
}

void Tracker::Impl::propose_keyframe(const LocalMapSnapshot& map,
                                     int inliers,
                                     TrackResult& result) {
  if (config.tracker.localisation_only) return;
  const bool last_is_mapped = !map.keyframes.empty() && map.newest + 1 == next_keyframe;
  const SnapshotKeyframe* reference = map.find_keyframe(last->reference);
  if (!last_is_mapped || reference == nullptr) return;
  const KeyframeEvidence evidence =
      weigh_view(map, *reference, *last->features, last->T_world_camera, inliers);
  if (is_worth_a_keyframe(evidence, config.tracker)) result.keyframe = make_candidate();
}

KeyframeCandidate Tracker::Impl::make_candidate() {
  KeyframeCandidate candidate{.id = next_keyframe++,
                              .reference = last->reference,
                              .T_reference_camera = last->T_reference_camera,
                              .features = last->features,
                              .points = last->points,
                              .doubtful = last->doubtful};
  candidate.sightings = sorted(sightings);
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
  const cv::Mat verdicts =
      impl_->filter.judge_by_class(frame, mask, impl_->predict(frame.stamp_ns));
  const auto dynamic_pixels =
      impl_->filter.leaves_out_by_class() ? DynamicPixels::kLeaveOut : DynamicPixels::kKeep;
  Features features = impl_->extractor.extract(frame, verdicts, dynamic_pixels);
  if (impl_->filter.uses_mask()) {
    features.mask_age_frames = static_cast<int>(frame.seq - mask->frame_seq);
  }
  return std::make_shared<const Features>(std::move(features));
}

TrackResult Tracker::track(const std::shared_ptr<const Features>& features,
                           const LocalMapSnapshot& whole_map) {
  TrackResult result{.seq = features->seq,
                     .stamp_ns = features->stamp_ns,
                     .features = features->counts,
                     .mask_age_frames = features->mask_age_frames};
  impl_->filter.note_features(features);
  if (!impl_->started && whole_map.keyframes.empty()) {
    result.verdicts = report(*features, impl_->extractor.left_out(), {});
    impl_->start_map(features, result);
    return result;
  }
  if (!impl_->started) impl_->enter_map(whole_map, features->stamp_ns);
  const LocalMapSnapshot& map = impl_->follow_part(whole_map);
  impl_->follow_map(map);
  FirstLook first = impl_->look(features, map, result);
  const std::optional<Fix> fix =
      impl_->finder.find(impl_->query(*first.features, map), std::move(first.fix));
  if (!fix) {
    impl_->lose(result, impl_->why_lost());
    if (impl_->is_lost_for_long(features->stamp_ns)) impl_->begin_part(first.features, result);
    return result;
  }
  result.matches = fix->matches.count();
  impl_->accept(first, map, *fix, result);
  if (impl_->filter.has_new_mask() && !impl_->config.tracker.localisation_only) {
    for (const SnapshotPoint& point : map.points) {
      if (impl_->filter.was_dynamic(point.position)) result.dynamic_points.push_back(point.id);
    }
  }
  return result;
}

}  // namespace tsg
