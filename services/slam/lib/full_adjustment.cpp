#include "services/slam/lib/full_adjustment.hpp"

#include <algorithm>
#include <unordered_set>

#include "services/slam/lib/map_motion.hpp"
#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr int kAdjustmentRounds =
    2;  // the second without the sightings that the first showed to be wrong
constexpr int kRoundIterations = 10;  // of a round
// A point that one keyframe sees says nothing of poses; it moves along with its keyframe.
constexpr std::size_t kMinSightings = 2;

}  // namespace

FullAdjustment::FullAdjustment(const Map& map, const ObservationModel& model, MapPart part)
    : rounds_left_(kAdjustmentRounds), iterations_left_(kRoundIterations) {
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (keyframe.part != part) continue;
    problem_.cameras.push_back({keyframe.T_world_camera.inverse(), part_begun_by(id) == part});
    keyframes_.push_back(id);
  }
  std::unordered_set<PointId> known = {kNoPoint};
  for (const KeyframeId id : keyframes_) {
    for (const PointId point : map.keyframe(id).points) {
      if (known.insert(point).second) add_point(map, model, *map.find_point(point));
    }
  }
}

void FullAdjustment::add_point(const Map& map,
                               const ObservationModel& model,
                               const MapPoint& point) {
  if (point.observations.size() < kMinSightings) return;
  points_.push_back(point.id);
  problem_.points.push_back(point.position);
  for (const Observation& observation : point.observations) {
    const auto camera = static_cast<std::size_t>(
        std::lower_bound(keyframes_.begin(), keyframes_.end(), observation.keyframe) -
        keyframes_.begin());
    if ((problem_.cameras[camera].T_camera_world * point.position).z() < kMinDepth) continue;
    const Features& features = *map.keyframe(observation.keyframe).features;
    const Feature& feature = features.items[static_cast<std::size_t>(observation.feature)];
    problem_.sightings.push_back({camera, points_.size() - 1, model.observe(feature)});
  }
}

void FullAdjustment::advance(const ObservationModel& model,
                             const std::function<bool()>& must_stop) {
  while (!is_done()) {
    iterate(model, must_stop);
    if (iterations_left_ > 0) return;
    --rounds_left_;
    iterations_left_ = kRoundIterations;
    take_out_misfits(model);
  }
}

/// Stops early or brings the round to its end.
void FullAdjustment::iterate(const ObservationModel& model,
                             const std::function<bool()>& must_stop) {
  bool stopped = false;
  bool has_begun = false;  // the solver asks before the first iteration too: one is always done
  const BundleLimits limits{.max_iterations = iterations_left_, .must_stop = [&] {
                              stopped = has_begun && must_stop && must_stop();
                              has_begun = true;
                              return stopped;
                            }};
  const BundleSummary summary = adjust_bundle(model, limits, problem_);
  iterations_left_ = stopped ? iterations_left_ - std::max(summary.iterations, 1) : 0;
}

void FullAdjustment::take_out_misfits(const ObservationModel& model) {
  const auto first = std::stable_partition(
      problem_.sightings.begin(), problem_.sightings.end(),
      [&](const BundleProblem::Sighting& sighting) {
        const SE3& T_camera_world = problem_.cameras[sighting.camera].T_camera_world;
        const Eigen::Vector3d p_camera = T_camera_world * problem_.points[sighting.point];
        return p_camera.z() > kMinDepth &&
               ObservationModel::is_inlier(model.residual(sighting.observation, p_camera));
      });
  misfits_.insert(misfits_.end(), first, problem_.sightings.end());
  problem_.sightings.erase(first, problem_.sightings.end());
}

void FullAdjustment::write_back(Map& map, const ObservationModel& model) const {
  KeyframeTargets targets;
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    targets[keyframes_[i]] = problem_.cameras[i].T_camera_world.inverse();
  }
  move_map(map, model, targets);
  for (const BundleProblem::Sighting& misfit : misfits_) {
    map.remove_observation_if_any(points_[misfit.point], keyframes_[misfit.camera]);
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    MapPoint* point = map.find_point(points_[i]);
    if (point == nullptr) continue;
    point->position = problem_.points[i];
    map.update_appearance(*point, model);
  }
}

}  // namespace tsg
