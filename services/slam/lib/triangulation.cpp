#include "services/slam/lib/triangulation.hpp"

#include <Eigen/LU>
#include <cmath>

#include "services/slam/lib/feature_matcher.hpp"
#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

// Radians. A quarter of the depth is uncertain then; but among people little else than far points
// may be in view, and they hold the rotation.
constexpr double kMinParallax = 0.008;
constexpr int kMaxNeighbours = 5;  // matching by looks takes half a millisecond each
constexpr int kMaxDistance = 50;   // of descriptors: a wrong point stays for a while
constexpr float kMaxRatio = 0.8F;
constexpr double kMaxLevelError = 1.5;  // levels that the two sizes differ from what distance does

/// Features that neither have a depth nor show a point: candidates for triangulation.
std::vector<bool> without_depth(const Keyframe& keyframe) {
  std::vector<bool> candidates(keyframe.points.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i] = keyframe.points[i] == kNoPoint && !keyframe.banned[i] &&
                    !keyframe.features->items[i].has_depth();
  }
  return candidates;
}

bool fits(const ObservationModel& model,
          const PointObservation& observation,
          const Eigen::Vector3d& p_camera) {
  return p_camera.z() > kMinDepth &&
         ObservationModel::is_inlier(model.residual(observation, p_camera));
}

/// A thing looks the smaller the farther it is, and is found on a finer level then.
bool is_size_plausible(const ObservationModel& model,
                       const Feature& a,
                       double distance_a,
                       const Feature& b,
                       double distance_b) {
  const double grows = model.level_scale(a.level) / model.level_scale(b.level);
  const double expected = distance_b / distance_a;
  return std::abs(std::log(grows / expected)) < kMaxLevelError * std::log(model.level_scale(1));
}

class PairOfViews {
 public:
  PairOfViews(Map& map,
              const ObservationModel& model,
              double min_depth_m,
              KeyframeId newest,
              KeyframeId neighbour)
      : map_(map),
        model_(model),
        min_depth_m_(min_depth_m),
        newest_(*map.find_keyframe(newest)),
        neighbour_(*map.find_keyframe(neighbour)),
        T_neighbour_newest_(neighbour_.T_world_camera.inverse() * newest_.T_world_camera) {}

  void add_points(std::vector<PointId>& added) {
    const std::vector<bool> theirs = without_depth(neighbour_);
    const auto matches =
        match_by_descriptor(*newest_.features, without_depth(newest_), *neighbour_.features,
                            {.max_distance = kMaxDistance, .max_ratio = kMaxRatio});
    for (const FeatureMatch& match : matches) {
      if (theirs[static_cast<std::size_t>(match.feature)]) add_point(match, added);
    }
  }

 private:
  void add_point(const FeatureMatch& match, std::vector<PointId>& added) {
    const Feature& a = newest_.features->items[static_cast<std::size_t>(match.source)];
    const Feature& b = neighbour_.features->items[static_cast<std::size_t>(match.feature)];
    const auto p_newest =
        triangulate(model_, model_.observe(a), model_.observe(b), T_neighbour_newest_);
    if (!p_newest || p_newest->z() < min_depth_m_) return;
    const double distance_b = (T_neighbour_newest_ * *p_newest).norm();
    if (!is_size_plausible(model_, a, p_newest->norm(), b, distance_b)) return;
    const PointId id = map_.add_point(newest_.T_world_camera * *p_newest, newest_, match.source);
    MapPoint& point = *map_.find_point(id);
    Map::add_observation(point, neighbour_, match.feature);
    map_.update_appearance(point, model_);
    added.push_back(id);
  }

  Map& map_;
  const ObservationModel& model_;
  double min_depth_m_;
  Keyframe& newest_;
  Keyframe& neighbour_;
  SE3 T_neighbour_newest_;
};

}  // namespace

std::optional<Eigen::Vector3d> triangulate(const ObservationModel& model,
                                           const PointObservation& a,
                                           const PointObservation& b,
                                           const SE3& T_b_a) {
  const Eigen::Vector3d sight_a = model.camera().unproject(a.pixel, 1.0);
  const SE3 T_a_b = T_b_a.inverse();
  const Eigen::Vector3d sight_b = T_a_b.rotation() * model.camera().unproject(b.pixel, 1.0);
  const double cosine = sight_a.normalized().dot(sight_b.normalized());
  if (cosine > std::cos(kMinParallax)) return std::nullopt;
  // The nearest points of the two lines: depth_a * sight_a = t_a_b + depth_b * sight_b.
  Eigen::Matrix<double, 3, 2> sights;
  sights << sight_a, -sight_b;
  const Eigen::Vector2d depths =
      (sights.transpose() * sights).inverse() * sights.transpose() * T_a_b.translation();
  const Eigen::Vector3d p_a =
      0.5 * (depths.x() * sight_a + T_a_b.translation() + depths.y() * sight_b);
  if (!fits(model, a, p_a) || !fits(model, b, T_b_a * p_a)) return std::nullopt;
  return p_a;
}

std::vector<PointId> add_points_by_triangulation(Map& map,
                                                 const ObservationModel& model,
                                                 const SlamConfig& config,
                                                 KeyframeId newest) {
  std::vector<PointId> added;
  int neighbours = 0;
  for (const Covisibility& neighbour : map.covisible_with(map.keyframe(newest))) {
    if (neighbour.shared < config.mapper.min_shared_points || neighbours++ >= kMaxNeighbours) break;
    PairOfViews(map, model, config.features.max_depth_m, newest, neighbour.keyframe)
        .add_points(added);
  }
  return added;
}

}  // namespace tsg
