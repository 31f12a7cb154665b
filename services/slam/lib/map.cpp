#include "services/slam/lib/map.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "common/core/check.hpp"

namespace tsg {
namespace {

auto find_observation(std::vector<Observation>& observations, KeyframeId keyframe) {
  return std::lower_bound(observations.begin(), observations.end(), keyframe,
                          [](const Observation& observation, KeyframeId wanted) {
                            return observation.keyframe < wanted;
                          });
}

/// Index of the descriptor with the least median distance to the others.
std::size_t most_typical(const std::vector<const Descriptor*>& descriptors) {
  std::size_t best = 0;
  int least_median = std::numeric_limits<int>::max();
  std::vector<int> distances(descriptors.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    for (std::size_t k = 0; k < descriptors.size(); ++k) {
      distances[k] = hamming_distance(*descriptors[i], *descriptors[k]);
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>((distances.size() - 1) / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle < least_median) {
      least_median = *middle;
      best = i;
    }
  }
  return best;
}

}  // namespace

Map::Map(std::vector<Keyframe> keyframes, std::vector<MapPoint> points, PointId next_point)
    : next_point_(next_point) {
  for (Keyframe& keyframe : keyframes) {
    keyframe.points.assign(keyframe.features->size(), kNoPoint);
    add_keyframe(std::move(keyframe));
  }
  for (MapPoint& point : points) {
    for (const Observation& observation : point.observations) {
      Keyframe& keyframe = keyframes_.at(observation.keyframe);
      keyframe.points.at(static_cast<std::size_t>(observation.feature)) = point.id;
    }
    const PointId id = point.id;
    TSG_CHECK(id < next_point_ && points_.emplace(id, std::move(point)).second);
  }
}

Keyframe& Map::add_keyframe(Keyframe keyframe) {
  const KeyframeId id = keyframe.id;
  const auto [position, inserted] = keyframes_.emplace(id, std::move(keyframe));
  TSG_CHECK(inserted);
  return position->second;
}

PointId Map::add_point(const Eigen::Vector3d& position, Keyframe& keyframe, int feature) {
  const PointId id = next_point_++;
  MapPoint& point = points_[id];
  point.id = id;
  point.position = position;
  point.created_in = keyframe.id;
  TSG_CHECK(add_observation(point, keyframe, feature));
  return id;
}

bool Map::add_observation(MapPoint& point, Keyframe& keyframe, int feature) {
  const auto i = static_cast<std::size_t>(feature);
  if (keyframe.points[i] != kNoPoint || keyframe.banned[i]) return false;
  const auto place = find_observation(point.observations, keyframe.id);
  if (place != point.observations.end() && place->keyframe == keyframe.id) return false;
  point.observations.insert(place, {keyframe.id, feature});
  keyframe.points[i] = point.id;
  return true;
}

void Map::remove_observation(PointId id, KeyframeId keyframe) {
  MapPoint& point = points_.at(id);
  const auto place = find_observation(point.observations, keyframe);
  TSG_CHECK(place != point.observations.end() && place->keyframe == keyframe);
  keyframes_.at(keyframe).points[static_cast<std::size_t>(place->feature)] = kNoPoint;
  point.observations.erase(place);
  if (point.observations.empty()) points_.erase(id);
}

bool Map::remove_observation_if_any(PointId id, KeyframeId keyframe) {
  const MapPoint* point = find_point(id);
  if (point == nullptr) return false;
  const bool is_there =
      std::any_of(point->observations.begin(), point->observations.end(),
                  [&](const Observation& observation) { return observation.keyframe == keyframe; });
  if (is_there) remove_observation(id, keyframe);
  return is_there;
}

void Map::remove_point(PointId id) {
  const auto place = points_.find(id);
  if (place == points_.end()) return;
  for (const Observation& observation : place->second.observations) {
    keyframes_.at(observation.keyframe).points[static_cast<std::size_t>(observation.feature)] =
        kNoPoint;
  }
  points_.erase(place);
}

void Map::remove_keyframe(KeyframeId id) {
  const std::vector<PointId> points = keyframes_.at(id).points;
  for (const PointId point : points) {
    if (point != kNoPoint) remove_observation(point, id);
  }
  keyframes_.erase(id);
}

void Map::merge_points(PointId from, PointId to) {
  TSG_CHECK(from != to);
  const MapPoint source = points_.at(from);
  remove_point(from);
  MapPoint& target = points_.at(to);
  for (const Observation& observation : source.observations) {
    add_observation(target, keyframes_.at(observation.keyframe), observation.feature);
  }
  target.expected += source.expected;
  target.found += source.found;
}

void Map::update_appearance(MapPoint& point, const ObservationModel& model) const {
  std::vector<const Descriptor*> descriptors;
  Eigen::Vector3d directions = Eigen::Vector3d::Zero();
  for (const Observation& observation : point.observations) {
    const Keyframe& seen_by = keyframes_.at(observation.keyframe);
    directions += (seen_by.T_world_camera.translation() - point.position).normalized();
    descriptors.push_back(
        &seen_by.features->descriptors[static_cast<std::size_t>(observation.feature)]);
  }
  point.normal = directions.normalized();
  const std::size_t typical = most_typical(descriptors);
  point.descriptor = *descriptors[typical];
  const Observation& observation = point.observations[typical];
  const Keyframe& reference = keyframes_.at(observation.keyframe);
  const Feature& feature = reference.features->items[static_cast<std::size_t>(observation.feature)];
  const double distance = (reference.T_world_camera.translation() - point.position).norm();
  point.max_distance = distance * model.level_scale(feature.level);
  point.min_distance = point.max_distance / model.level_scale(model.levels() - 1);
}

std::vector<Covisibility> Map::covisible_with(const Keyframe& keyframe) const {
  std::map<KeyframeId, int> shared;
  for (const PointId id : keyframe.points) {
    if (id == kNoPoint) continue;
    for (const Observation& observation : points_.at(id).observations) {
      if (observation.keyframe != keyframe.id) ++shared[observation.keyframe];
    }
  }
  std::vector<Covisibility> neighbours;
  neighbours.reserve(shared.size());
  for (const auto& [id, count] : shared) neighbours.push_back({id, count});
  std::stable_sort(
      neighbours.begin(), neighbours.end(),
      [](const Covisibility& a, const Covisibility& b) { return a.shared > b.shared; });
  return neighbours;
}

std::vector<MapPoint> Map::points_by_id() const {
  std::vector<PointId> ids;
  for (const auto& [keyframe_id, keyframe] : keyframes_) {
    ids.insert(ids.end(), keyframe.points.begin(), keyframe.points.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (!ids.empty() && ids.back() == kNoPoint) ids.pop_back();
  std::vector<MapPoint> points;
  points.reserve(ids.size());
  for (const PointId id : ids) points.push_back(points_.at(id));
  return points;
}

MapPoint* Map::find_point(PointId id) {
  const auto place = points_.find(id);
  return place == points_.end() ? nullptr : &place->second;
}

const MapPoint* Map::find_point(PointId id) const {
  const auto place = points_.find(id);
  return place == points_.end() ? nullptr : &place->second;
}

Keyframe* Map::find_keyframe(KeyframeId id) {
  const auto place = keyframes_.find(id);
  return place == keyframes_.end() ? nullptr : &place->second;
}

}  // namespace tsg
