#include "services/slam/lib/local_window.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {}  // namespace

LocalWindow::LocalWindow(const Map& map,
                         const ObservationModel& model,
                         const MapperConfig& config,
                         KeyframeId newest) {
  const Keyframe& centre = map.keyframe(newest);
  add_camera(centre, part_begun_by(newest) == centre.part);
  for (const Covisibility& neighbour : map.covisible_with(centre)) {
    if (static_cast<int>(keyframes_.size()) >= config.window_keyframes) break;
    if (neighbour.shared < config.min_shared_points) break;
    add_camera(map.keyframe(neighbour.keyframe), part_begun_by(neighbour.keyframe) == centre.part);
  }
  collect_points(map);
  add_outer_keyframes(map, config);
  add_sightings(map, model);
}

void LocalWindow::add_camera(const Keyframe& keyframe, bool fixed) {
  keyframes_.push_back(keyframe.id);
  problem_.cameras.push_back({keyframe.T_world_camera.inverse(), fixed});
}

void LocalWindow::collect_points(const Map& map) {
  std::unordered_set<PointId> known;
  for (const KeyframeId id : keyframes_) {
    for (const PointId point : map.keyframe(id).points) {
      if (point == kNoPoint || !known.insert(point).second) continue;
      points_.push_back(point);
      problem_.points.push_back(map.find_point(point)->position);
    }
  }
}

void LocalWindow::add_outer_keyframes(const Map& map, const MapperConfig& config) {
  std::map<KeyframeId, int> shared;
  for (const PointId point : points_) {
    for (const Observation& observation : map.find_point(point)->observations) {
      ++shared[observation.keyframe];
    }
  }
  for (const KeyframeId inner : keyframes_) shared.erase(inner);
  std::vector<Covisibility> outer;
  outer.reserve(shared.size());
  for (const auto& [id, count] : shared) outer.push_back({id, count});
  std::stable_sort(outer.begin(), outer.end(), [](const Covisibility& a, const Covisibility& b) {
    return a.shared > b.shared;
  });
  outer.resize(std::min(outer.size(), static_cast<std::size_t>(config.fixed_keyframes)));
  for (const Covisibility& keyframe : outer) add_camera(map.keyframe(keyframe.keyframe), true);
  const bool held = std::any_of(problem_.cameras.begin(), problem_.cameras.end(),
                                [](const BundleProblem::Camera& camera) { return camera.fixed; });
  if (held) return;
  const auto oldest = std::min_element(keyframes_.begin(), keyframes_.end());
  problem_.cameras[static_cast<std::size_t>(oldest - keyframes_.begin())].fixed = true;
}

void LocalWindow::add_sightings(const Map& map, const ObservationModel& model) {
  std::unordered_map<KeyframeId, std::size_t> camera_of;
  for (std::size_t i = 0; i < keyframes_.size(); ++i) camera_of[keyframes_[i]] = i;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (const Observation& observation : map.find_point(points_[i])->observations) {
      const auto camera = camera_of.find(observation.keyframe);
      if (camera == camera_of.end()) continue;
      const SE3& T_camera_world = problem_.cameras[camera->second].T_camera_world;
      if ((T_camera_world * problem_.points[i]).z() < kMinDepth) continue;
      const Features& features = *map.keyframe(observation.keyframe).features;
      const Feature& feature = features.items[static_cast<std::size_t>(observation.feature)];
      problem_.sightings.push_back({camera->second, i, model.observe(feature)});
    }
  }
}

void LocalWindow::write_back(Map& map, const ObservationModel& model) const {
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    const BundleProblem::Camera& camera = problem_.cameras[i];
    if (!camera.fixed) {
      map.find_keyframe(keyframes_[i])->T_world_camera = camera.T_camera_world.inverse();
    }
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    map.find_point(points_[i])->position = problem_.points[i];
  }
  for (const BundleProblem::Sighting& sighting : problem_.sightings) {
    const BundleProblem::Camera& camera = problem_.cameras[sighting.camera];
    const Eigen::Vector3d p_camera = camera.T_camera_world * problem_.points[sighting.point];
    const bool fits = p_camera.z() > kMinDepth &&
                      ObservationModel::is_inlier(model.residual(sighting.observation, p_camera));
    if (!fits) map.remove_observation(points_[sighting.point], keyframes_[sighting.camera]);
  }
  for (const PointId id : points_) {
    MapPoint* point = map.find_point(id);
    if (point != nullptr) map.update_appearance(*point, model);
  }
}

}  // namespace tsg
