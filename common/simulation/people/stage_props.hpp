#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "common/simulation/people/choreography.hpp"

namespace tsg::simulation {

/// That a prop goes with the hands of a person while a segment lasts.
struct PropMove {
  double begin_s = 0.0;
  double end_s = 0.0;
  std::size_t person = 0;
  std::size_t segment = 0;
};

/// A prop while everybody's actions are planned: where the last of them has left it.
struct PlannedProp {
  std::string name;
  Prop prop;
  SE3 T_world_now;
  double free_at_s = 0.0;       ///< kInUse while somebody has it and the end is not planned yet
  std::size_t used_by = 0;      ///< person, while in use
  std::vector<PropMove> moves;  ///< by time

  static constexpr double kInUse = std::numeric_limits<double>::infinity();

  /// Where it stands now, seen from above.
  [[nodiscard]] FloorPose floor_pose() const;
  [[nodiscard]] double base_z_m() const { return T_world_now.translation().z(); }
  /// Half of its extent along `direction_rad` (of the world).
  [[nodiscard]] double half_extent_m(double direction_rad) const;
};

/// All props, by the order of their names.
class PropStage {
 public:
  explicit PropStage(const std::map<std::string, Prop>& props);

  [[nodiscard]] std::size_t index_of(const std::string& name) const;
  [[nodiscard]] PlannedProp& at(std::size_t index) { return props_.at(index); }
  [[nodiscard]] const std::vector<PlannedProp>& all() const { return props_; }
  /// Height of what a thing stands on that is put down at `place_m`: a table top, else the floor.
  [[nodiscard]] double support_z_m(const Eigen::Vector2d& place_m, std::size_t except) const;

 private:
  std::vector<PlannedProp> props_;
};

/// Corners between `from_m` and `to_m` (both left out) of a way that keeps clear of a prop.
[[nodiscard]] std::vector<Eigen::Vector2d> way_around(const PlannedProp& prop,
                                                      const Eigen::Vector2d& from_m,
                                                      const Eigen::Vector2d& to_m);

}  // namespace tsg::simulation
