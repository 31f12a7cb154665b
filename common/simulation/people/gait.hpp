#pragma once

#include "common/simulation/people/posture.hpp"
#include "common/simulation/people/route.hpp"

namespace tsg::simulation {

/// Steps along a route. A foot is put down at a place and stays there while the body passes over
/// it, so that it never slides, whatever the speed.
class Gait {
 public:
  /// `rolls`: from the heel to the toes, as one does walking forward only.
  Gait(const Skeleton& skeleton, const Route& route, double speed_mps, bool rolls);

  /// The person's pose and how the body is held after `along_m` of the route, arms swinging.
  /// Begins and ends in standing_posture().
  [[nodiscard]] Posture at(const Skeleton& skeleton, const Route& route, double along_m) const;

  [[nodiscard]] int steps() const { return steps_; }

 private:
  struct Swing;
  [[nodiscard]] Swing swing_of(Side side, double phase) const;
  [[nodiscard]] FootPosture foot_at(const Skeleton& skeleton,
                                    const Route& route,
                                    Side side,
                                    double phase) const;
  [[nodiscard]] Side side_of_step(int step) const;
  [[nodiscard]] double landing_m(int step) const;
  [[nodiscard]] double rhythm(double phase) const;

  int steps_ = 1;
  double step_m_ = 0.0;
  Side first_ = Side::kRight;
  bool rolls_;
  double stride_ = 0.0;  ///< length of its steps relative to a brisk walk's
};

}  // namespace tsg::simulation
