#include "services/slam/lib/local_mapper.hpp"

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "common/core/check.hpp"
#include "services/slam/lib/depth_points.hpp"
#include "services/slam/lib/dynamic/class_policy.hpp"
#include "services/slam/lib/local_window.hpp"
#include "services/slam/lib/loop_closer.hpp"
#include "services/slam/lib/map.hpp"
#include "services/slam/lib/map_contents.hpp"
#include "services/slam/lib/map_culling.hpp"
#include "services/slam/lib/point_fusion.hpp"
#include "services/slam/lib/snapshot_builder.hpp"
#include "services/slam/lib/triangulation.hpp"

namespace tsg {
namespace {

constexpr std::size_t kMaxRecalled = 4;  // places tried for a lost frame; bounds its time
// A map that was left so early is not worth waiting for: the next part takes over as the main one.
constexpr std::size_t kWorthKeeping = 10;  // keyframes

std::map<MapPart, std::size_t> keyframes_by_part(const Map& map) {
  std::map<MapPart, std::size_t> counts;
  for (const auto& [id, keyframe] : map.keyframes()) ++counts[keyframe.part];
  return counts;
}

}  // namespace

struct LocalMapper::Impl {
  Impl(const SlamConfig& slam_config, const CameraModel& camera)
      : config(slam_config), model(camera, slam_config), closer(model, config) {}

  void link_tracked_points(const KeyframeCandidate& candidate, Keyframe& keyframe);
  void note_sightings(const std::vector<PointSighting>& sightings);
  void cull_keyframe(KeyframeId id);
  void begin_part(MapPart part);
  /// The keyframe that stands for `id`, culled or not, and where `id` is seen from it.
  struct Place {
    KeyframeId ancestor = 0;
    SE3 T_ancestor_camera;
  };
  [[nodiscard]] Place place_of(KeyframeId id) const;
  [[nodiscard]] SE3 pose_of(KeyframeId id) const;
  void publish(LocalMapSnapshot snapshot);

  SlamConfig config;
  ObservationModel model;
  Map map;
  LoopCloser closer;
  KeyframeId newest = 0;
  MapPart main_part = 0;
  std::vector<KeyframeId> recalled;    ///< what the snapshot is of until the next keyframe
  KeyframeId first_of_session = 0;     ///< earlier ones come from a map that was kept
  std::vector<PointId> recent_points;  ///< on trial, see cull_recent_points()
  std::map<KeyframeId, CulledKeyframe> culled;
  std::uint64_t version = 0;
  std::uint64_t corrections = 0;
  std::shared_ptr<const LocalMapSnapshot> published;  ///< null where the map has changed since
};

void LocalMapper::Impl::link_tracked_points(const KeyframeCandidate& candidate,
                                            Keyframe& keyframe) {
  for (std::size_t i = 0; i < candidate.points.size(); ++i) {
    if (candidate.points[i] == kNoPoint) continue;
    MapPoint* point = map.find_point(candidate.points[i]);  // may be gone since it was tracked
    if (point != nullptr && Map::add_observation(*point, keyframe, static_cast<int>(i))) {
      map.update_appearance(*point, model);
    }
  }
}

void LocalMapper::Impl::note_sightings(const std::vector<PointSighting>& sightings) {
  for (const PointSighting& sighting : sightings) {
    MapPoint* point = map.find_point(sighting.id);
    if (point == nullptr) continue;
    point->expected += sighting.expected;
    point->found += sighting.found;
  }
}

void LocalMapper::Impl::cull_keyframe(KeyframeId id) {
  const Keyframe& keyframe = map.keyframe(id);
  const auto neighbours = map.covisible_with(keyframe);
  const KeyframeId parent = neighbours.empty() ? keyframe.part : neighbours.front().keyframe;
  culled[id] = {
      .parent = parent,
      .T_parent_camera = map.keyframe(parent).T_world_camera.inverse() * keyframe.T_world_camera,
      .seq = keyframe.features->seq,
      .stamp_ns = keyframe.features->stamp_ns};
  closer.remove(id, parent, culled[id].T_parent_camera);
  map.remove_keyframe(id);
}

LocalMapper::Impl::Place LocalMapper::Impl::place_of(KeyframeId id) const {
  SE3 T_ancestor_camera;
  auto place = culled.find(id);
  while (place != culled.end()) {
    T_ancestor_camera = place->second.T_parent_camera * T_ancestor_camera;
    id = place->second.parent;
    place = culled.find(id);
  }
  return {id, T_ancestor_camera};
}

SE3 LocalMapper::Impl::pose_of(KeyframeId id) const {
  const Place place = place_of(id);
  return map.keyframe(place.ancestor).T_world_camera * place.T_ancestor_camera;
}

void LocalMapper::Impl::begin_part(MapPart part) {
  if (keyframes_by_part(map)[main_part] < kWorthKeeping) main_part = part;
}

void LocalMapper::Impl::publish(LocalMapSnapshot snapshot) {
  snapshot.version = ++version;
  snapshot.corrections = corrections;
  snapshot.main_part = main_part;
  published = std::make_shared<const LocalMapSnapshot>(std::move(snapshot));
}

LocalMapper::LocalMapper(const SlamConfig& config, const CameraModel& camera)
    : impl_(std::make_unique<Impl>(config, camera)) {}
LocalMapper::LocalMapper(const SlamConfig& config, MapContents&& contents)
    : impl_(std::make_unique<Impl>(config, contents.camera)) {
  TSG_CHECK(!contents.keyframes.empty());
  impl_->map = Map(std::move(contents.keyframes), std::move(contents.points), contents.next_point);
  impl_->culled = std::move(contents.culled);
  impl_->recent_points = std::move(contents.recent_points);
  impl_->newest = contents.newest;
  const auto parts = keyframes_by_part(impl_->map);
  impl_->main_part =
      std::ranges::max_element(parts, {}, [](const auto& part) { return part.second; })->first;
  impl_->first_of_session = contents.newest + 1;
  const bool may_adjust = !config.tracker.localisation_only;
  impl_->closer.take_over(impl_->map, std::move(contents.loops),
                          may_adjust && contents.is_adjusting);
}

LocalMapper::~LocalMapper() = default;
LocalMapper::LocalMapper(LocalMapper&&) noexcept = default;
LocalMapper& LocalMapper::operator=(LocalMapper&&) noexcept = default;

/// What was not seen to stand still yet is left to a later keyframe, unless the map has it already.
std::vector<bool> banned_at_first(const KeyframeCandidate& candidate) {
  std::vector<bool> banned(candidate.features->size(), false);
  for (std::size_t i = 0; i < candidate.doubtful.size(); ++i) {
    banned[i] = candidate.doubtful[i] && candidate.points[i] == kNoPoint;
  }
  return banned;
}

void LocalMapper::insert(KeyframeCandidate&& candidate) {
  impl_->published.reset();
  impl_->recalled.clear();
  MapPart part = part_begun_by(candidate.id);
  SE3 T_world_reference;
  if (candidate.reference == candidate.id) {
    impl_->begin_part(part);
  } else {
    T_world_reference = impl_->pose_of(candidate.reference);
    part = impl_->map.keyframe(impl_->place_of(candidate.reference).ancestor).part;
  }
  Keyframe& keyframe =
      impl_->map.add_keyframe({.id = candidate.id,
                               .part = part,
                               .features = candidate.features,
                               .T_world_camera = T_world_reference * candidate.T_reference_camera,
                               .points = std::vector<PointId>(candidate.features->size(), kNoPoint),
                               .banned = banned_at_first(candidate)});
  impl_->newest = candidate.id;
  impl_->note_sightings(candidate.sightings);
  impl_->link_tracked_points(candidate, keyframe);
  const auto put_on_trial = [this](const std::vector<PointId>& added) {
    impl_->recent_points.insert(impl_->recent_points.end(), added.begin(), added.end());
  };
  put_on_trial(add_points_from_depth(impl_->map, impl_->model, keyframe));
  fuse_with_neighbours(impl_->map, impl_->model, impl_->config.mapper, candidate.id);
  put_on_trial(add_points_by_triangulation(impl_->map, impl_->model, impl_->config, candidate.id));
  cull_recent_points(impl_->map, impl_->newest, impl_->recent_points);
  impl_->closer.add(keyframe);
}

void LocalMapper::refine(const std::stop_token& stop) {
  if (impl_->map.keyframes().size() < 2) return;
  impl_->published.reset();
  const MapperConfig& config = impl_->config.mapper;
  LocalWindow window(impl_->map, impl_->model, config, impl_->newest);
  const BundleLimits limits{.max_iterations = config.max_iterations,
                            .time_budget_s = config.time_budget_s,
                            .must_stop = [&stop] { return stop.stop_requested(); }};
  if (adjust_bundle(impl_->model, limits, window.problem()).usable) {
    window.write_back(impl_->map, impl_->model);
  }
  while (!stop.stop_requested()) {
    const auto redundant = find_redundant_keyframe(impl_->map, config, impl_->newest);
    if (!redundant) break;
    impl_->cull_keyframe(*redundant);
  }
  if (impl_->closer.close(impl_->map, impl_->newest, impl_->main_part, limits.must_stop)) {
    ++impl_->corrections;
  }
}

bool LocalMapper::is_adjusting() const { return impl_->closer.is_adjusting(); }

void LocalMapper::adjust(const std::function<bool()>& must_stop) {
  if (!impl_->closer.adjust(impl_->map, must_stop)) return;
  impl_->published.reset();
  ++impl_->corrections;
}

void LocalMapper::remove_points(const std::vector<PointId>& points) {
  if (points.empty()) return;
  impl_->published.reset();
  for (const PointId id : points) impl_->map.remove_point(id);
}

bool LocalMapper::apply_mask(const InstanceSegmentation& mask) {
  if (!uses_masks(impl_->config.dynamic_filter.method)) return false;
  const auto& keyframes = impl_->map.keyframes();
  const auto place = std::find_if(keyframes.rbegin(), keyframes.rend(), [&](const auto& entry) {
    return entry.second.features->seq == mask.frame_seq;
  });
  if (place == keyframes.rend() || place->first < impl_->first_of_session) return false;
  impl_->published.reset();
  Keyframe& keyframe = *impl_->map.find_keyframe(place->first);
  const cv::Mat verdicts = exact_verdicts(mask, impl_->config.dynamic_filter);
  for (std::size_t i = 0; i < keyframe.points.size(); ++i) {
    const Feature& feature = keyframe.features->items[i];
    const auto verdict =
        static_cast<FeatureVerdict>(verdicts.at<std::uint8_t>(feature.raw_y, feature.raw_x));
    if (verdict != FeatureVerdict::kDynamic) continue;
    keyframe.banned[i] = true;
    // Whoever saw the same point saw the same moving thing.
    if (keyframe.points[i] != kNoPoint) impl_->map.remove_point(keyframe.points[i]);
  }
  return true;
}

void LocalMapper::recall(const Features& view) {
  std::vector<KeyframeId> recalled;
  for (const PlaceCandidate& candidate : impl_->closer.recall(view)) {
    if (recalled.size() == kMaxRecalled) break;
    // A snapshot has one world.
    const auto part_of = [this](KeyframeId id) { return impl_->map.keyframe(id).part; };
    const bool fits = recalled.empty() || part_of(candidate.keyframe) == part_of(recalled.front());
    if (fits) recalled.push_back(candidate.keyframe);
  }
  if (recalled.empty()) return;
  impl_->recalled = std::move(recalled);
  impl_->published.reset();
}

void LocalMapper::centre_on(KeyframeId id) {
  if (impl_->map.find_keyframe(id) == nullptr) return;
  LocalMapSnapshot snapshot = build_snapshot(impl_->map, impl_->config.mapper, id);
  snapshot.newest = impl_->newest;
  impl_->recalled.clear();
  impl_->publish(std::move(snapshot));
}

std::shared_ptr<const LocalMapSnapshot> LocalMapper::snapshot() {
  if (impl_->published) return impl_->published;
  LocalMapSnapshot snapshot;
  if (!impl_->recalled.empty()) {
    snapshot =
        build_recall_snapshot(impl_->map, impl_->config.mapper, impl_->newest, impl_->recalled);
  } else if (!impl_->map.keyframes().empty()) {
    snapshot = build_snapshot(impl_->map, impl_->config.mapper, impl_->newest);
  }
  impl_->publish(std::move(snapshot));
  return impl_->published;
}

std::vector<KeyframePose> LocalMapper::keyframe_poses() const {
  std::map<KeyframeId, KeyframePose> poses;
  for (const auto& [id, keyframe] : impl_->map.keyframes()) {
    poses[id] = {id, keyframe.features->seq, keyframe.features->stamp_ns, keyframe.T_world_camera,
                 keyframe.part};
  }
  for (const auto& [id, keyframe] : impl_->culled) {
    const MapPart part = impl_->map.keyframe(impl_->place_of(id).ancestor).part;
    poses[id] = {id, keyframe.seq, keyframe.stamp_ns, impl_->pose_of(id), part};
  }
  std::vector<KeyframePose> sorted;
  sorted.reserve(poses.size());
  for (const auto& [id, pose] : poses) sorted.push_back(pose);
  return sorted;
}

MapContents LocalMapper::contents() const {
  MapContents contents{.camera = impl_->model.camera(),
                       .keyframes = {},
                       .points = impl_->map.points_by_id(),
                       .culled = impl_->culled,
                       .loops = impl_->closer.loops(),
                       .recent_points = {},
                       .newest = impl_->newest,
                       .next_point = impl_->map.next_point(),
                       .is_adjusting = impl_->closer.is_adjusting()};
  for (const auto& [id, keyframe] : impl_->map.keyframes()) contents.keyframes.push_back(keyframe);
  for (const PointId id : impl_->recent_points) {
    if (impl_->map.find_point(id) != nullptr) contents.recent_points.push_back(id);
  }
  return contents;
}

}  // namespace tsg
