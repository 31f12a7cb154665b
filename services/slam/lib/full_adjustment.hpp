#pragma once

#include <functional>
#include <vector>

#include "services/slam/lib/bundle_adjustment.hpp"
#include "services/slam/lib/map.hpp"

namespace tsg {

/// Bundle adjustment of a whole part of the map, which takes longer than mapping may pause: works
/// on a copy, in as many slices as it takes, while the map goes on growing. The keyframe that began
/// the part stays.
class FullAdjustment {
 public:
  FullAdjustment(const Map& map, const ObservationModel& model, MapPart part);

  /// Works until `must_stop` (may be empty) says so after some iteration, or to the end.
  void advance(const ObservationModel& model, const std::function<bool()>& must_stop);
  [[nodiscard]] bool is_done() const { return rounds_left_ <= 0; }

  /// Puts the outcome into the map, which may have changed: what has come since moves along.
  void write_back(Map& map, const ObservationModel& model) const;

 private:
  void add_point(const Map& map, const ObservationModel& model, const MapPoint& point);
  void iterate(const ObservationModel& model, const std::function<bool()>& must_stop);
  void take_out_misfits(const ObservationModel& model);

  std::vector<KeyframeId> keyframes_;  ///< per camera of the problem
  std::vector<PointId> points_;        ///< per point of the problem
  BundleProblem problem_;
  std::vector<BundleProblem::Sighting> misfits_;  ///< no longer in the problem
  int rounds_left_;
  int iterations_left_;  ///< of this round
};

}  // namespace tsg
