#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry/se3.hpp"
#include "common/simulation/scene.hpp"

namespace tsg::simulation {

/// A polyline whose corners are rounded by arcs. Corners that turn back by more than 150 degrees
/// cannot be rounded: split the path there.
class RoundedPath {
 public:
  /// `corners`: at least two, no two neighbours closer than 1 cm.
  explicit RoundedPath(const std::vector<Eigen::Vector2d>& corners);

  [[nodiscard]] double length_m() const { return length_m_; }
  /// `along_m` is clamped to 0..length_m().
  [[nodiscard]] Eigen::Vector2d position_m(double along_m) const;
  /// Where a body looks that walks along: the direction of the path, averaged over half a metre,
  /// so that it turns into a bend little by little. Continuous, not wrapped.
  [[nodiscard]] double heading_rad(double along_m) const;

 private:
  /// A straight line (curvature 0) or an arc.
  struct Piece {
    Eigen::Vector2d from_m;
    double heading_rad;
    double curvature;  ///< 1/m, > 0 to the left
    double begin_m;
    double length_m;
  };

  [[nodiscard]] const Piece& piece_at(double along_m) const;
  [[nodiscard]] double direction_rad(double along_m) const;
  void add(double heading_rad, double curvature, double length_m);

  Eigen::Vector2d end_m_;
  double length_m_ = 0.0;
  std::vector<Piece> pieces_;
};

/// Where a walking person is as a function of the way that is behind: along a path, or turning and
/// shifting in place. With `trailing_m` the person follows at that distance behind what moves along
/// the route (a chair that is pushed).
class Route {
 public:
  struct Manner {
    double start_yaw_rad = 0.0;  ///< turns from here into the path's direction within 0.7 m
    bool backwards = false;
    double trailing_m = 0.0;
  };

  Route(RoundedPath path, const Manner& manner);
  /// From one pose to another that is not far.
  Route(const FloorPose& from, const FloorPose& to, double trailing_m);

  /// What a walk is planned by; of the path, or of the arc that the feet go when they turn.
  [[nodiscard]] double length_m() const { return length_m_; }
  [[nodiscard]] FloorPose person_at(double along_m) const;
  /// What moves ahead of the person; the person where nothing trails.
  [[nodiscard]] FloorPose leader_at(double along_m) const;

 private:
  std::vector<RoundedPath> path_;  ///< one or none
  Manner manner_;
  FloorPose from_;
  Eigen::Vector2d shift_m_ = Eigen::Vector2d::Zero();
  double turn_rad_ = 0.0;  ///< the path's: still to turn at its start
  double length_m_ = 0.0;
};

/// How far one has come: speeds up, keeps `speed_mps`, slows down; without jerks.
class SpeedProfile {
 public:
  SpeedProfile(double length_m, double speed_mps);

  [[nodiscard]] double duration_s() const { return duration_s_; }
  [[nodiscard]] double along_m(double time_s) const;

 private:
  double length_m_;
  double speed_mps_;
  double ramp_s_;
  double duration_s_;
};

/// Direction from one place to another.
[[nodiscard]] double heading_between(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m);

/// Cuts a polyline where it turns too sharply to be rounded; one walks to the end of a part, turns
/// there and walks on. Parts share their end points, have two corners or more, and none twice.
[[nodiscard]] std::vector<std::vector<Eigen::Vector2d>> walkable_parts(
    const std::vector<Eigen::Vector2d>& corners_m);

/// The same pose in space, on the floor.
[[nodiscard]] SE3 to_transform(const FloorPose& pose);

/// `pose` moved by `offset_m`, which is in its axes.
[[nodiscard]] Eigen::Vector2d moved_by(const FloorPose& pose, const Eigen::Vector2d& offset_m);

}  // namespace tsg::simulation
