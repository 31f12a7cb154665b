#pragma once

#include <vector>

#include "services/slam/lib/bundle_adjustment.hpp"
#include "services/slam/lib/map.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// The part of the map that local bundle adjustment works on: keyframes around the newest, the
/// points that they see, and outer keyframes that see these too and stay where they are.
class LocalWindow {
 public:
  LocalWindow(const Map& map,
              const ObservationModel& model,
              const MapperConfig& config,
              KeyframeId newest);

  [[nodiscard]] BundleProblem& problem() { return problem_; }

  /// Puts adjusted poses and points into `map` (the one of the constructor, not changed since) and
  /// takes out sightings that do not fit them.
  void write_back(Map& map, const ObservationModel& model) const;

 private:
  void add_camera(const Keyframe& keyframe, bool fixed);
  void collect_points(const Map& map);
  void add_outer_keyframes(const Map& map, const MapperConfig& config);
  void add_sightings(const Map& map, const ObservationModel& model);

  std::vector<KeyframeId> keyframes_;  ///< per camera of the problem
  std::vector<PointId> points_;        ///< per point of the problem
  BundleProblem problem_;
};

}  // namespace tsg
