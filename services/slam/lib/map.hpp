#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

#include "common/geometry/se3.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/ids.hpp"
#include "services/slam/lib/observation_model.hpp"

namespace tsg {

/// The sighting of a map point in a keyframe.
struct Observation {
  KeyframeId keyframe = 0;
  int feature = 0;
};

/// A point of the static world.
struct MapPoint {
  PointId id = kNoPoint;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< world
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, mean direction to the cameras
  double min_distance = 0.0;              ///< metres; nearer, it fills more than the coarsest level
  double max_distance = 0.0;              ///< metres at which it shows in level 0
  Descriptor descriptor{};                ///< of the observation that is closest to all others
  std::vector<Observation> observations;  ///< sorted by keyframe, at most one of each
  KeyframeId created_in = 0;
  int expected = 0;  ///< frames in which tracking looked for it
  int found = 0;     ///< and saw it
};

/// A frame kept in the map with its pose.
struct Keyframe {
  KeyframeId id = 0;
  MapPart part = 0;  ///< each part has a world of its own
  std::shared_ptr<const Features> features;
  SE3 T_world_camera;
  std::vector<PointId> points;  ///< per feature, or kNoPoint
  std::vector<bool>
      banned;  ///< per feature: on something that moves or may move, shows no map point
};

/// How many map points a keyframe shares with another.
struct Covisibility {
  KeyframeId keyframe = 0;
  int shared = 0;
};

/// Keyframes, map points and the observations that join them. Both ends of an observation are kept
/// in step here and nowhere else. Owned by LocalMapper.
class Map {
 public:
  Map() = default;
  /// The map that these are the parts of. What keyframes say of their points is not read: it
  /// follows from the observations. `next_point`: the id that the next new point gets.
  Map(std::vector<Keyframe> keyframes, std::vector<MapPoint> points, PointId next_point);

  Keyframe& add_keyframe(Keyframe keyframe);
  /// A new point first seen by a feature of `keyframe`.
  PointId add_point(const Eigen::Vector3d& position, Keyframe& keyframe, int feature);

  /// Joins point and feature unless one of them is joined already; says whether it did.
  static bool add_observation(MapPoint& point, Keyframe& keyframe, int feature);
  /// Takes an observation out, and the point with it when none is left.
  void remove_observation(PointId id, KeyframeId keyframe);
  /// The same where there may be no such observation any more; says whether there was.
  bool remove_observation_if_any(PointId id, KeyframeId keyframe);
  void remove_point(PointId id);
  void remove_keyframe(KeyframeId id);
  /// Gives the observations of `from` to `to` where its keyframes do not see `to`; removes `from`.
  void merge_points(PointId from, PointId to);

  /// Brings normal, distance range and descriptor in line with the observations.
  void update_appearance(MapPoint& point, const ObservationModel& model) const;

  /// Keyframes that share points with `keyframe`, most first.
  [[nodiscard]] std::vector<Covisibility> covisible_with(const Keyframe& keyframe) const;

  [[nodiscard]] MapPoint* find_point(PointId id);
  [[nodiscard]] const MapPoint* find_point(PointId id) const;
  [[nodiscard]] Keyframe* find_keyframe(KeyframeId id);
  [[nodiscard]] const Keyframe& keyframe(KeyframeId id) const { return keyframes_.at(id); }
  [[nodiscard]] const std::map<KeyframeId, Keyframe>& keyframes() const { return keyframes_; }
  [[nodiscard]] std::size_t point_count() const { return points_.size(); }
  [[nodiscard]] PointId next_point() const { return next_point_; }
  /// Copies of all points, sorted by id.
  [[nodiscard]] std::vector<MapPoint> points_by_id() const;

 private:
  std::map<KeyframeId, Keyframe> keyframes_;
  std::unordered_map<PointId, MapPoint> points_;  ///< never iterated: its order is no one's
  PointId next_point_ = 0;
};

}  // namespace tsg
