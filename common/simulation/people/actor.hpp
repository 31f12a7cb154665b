#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/simulation/people/stage_props.hpp"
#include "common/simulation/people/timeline.hpp"

namespace tsg::simulation {

/// Plans what one person does: turns actions into segments, one after the other, and moves props.
/// Holds a reference to the stage: not to outlive it.
class Actor {
 public:
  struct Role {
    std::size_t number = 0;  ///< which person
    PersonDescription person;
    Skeleton skeleton;
    std::uint64_t seed = 0;
  };

  Actor(const Role& role, PropStage& stage);

  [[nodiscard]] double now_s() const { return now_s_; }
  [[nodiscard]] bool is_done() const { return is_done_; }
  [[nodiscard]] const PersonDescription& person() const { return role_.person; }
  /// The action that is planned next.
  [[nodiscard]] std::size_t next_action() const { return next_action_; }
  /// A prop that the next action needs and somebody else has.
  [[nodiscard]] std::optional<std::size_t> blocking_prop() const;
  /// Plans to do nothing until then.
  void wait_until(double time_s);
  void plan_next_action();
  /// Everything planned, and doing nothing for ever after it.
  [[nodiscard]] Timeline take_timeline();

 private:
  /// How to follow a path; see Route::Manner.
  struct Walk {
    double speed_mps;
    bool backwards;
    double trailing_m;
  };

  void sit(const ActionDescription& action);
  void stand_up();
  void push(const ActionDescription& action);
  void take(const std::string& name);
  void put_down();
  void finish_round();

  /// Walks to a place, around an obstacle where there is one, and turns there.
  void go_to(const FloorPose& place, const PlannedProp* obstacle);
  void follow(const std::vector<Eigen::Vector2d>& corners, const Walk& walk);
  void turn_to(double yaw_rad, double gap_m);
  void stay(double duration_s, Gesture gesture, double fade_s);
  void move(const Route& route, double speed_mps, bool rolls);
  void append(Segment segment, double duration_s);
  void start_seated();
  [[nodiscard]] Sitting sitting_on(const PlannedProp& prop) const;
  [[nodiscard]] FloorPose place_before_seat(const PlannedProp& prop) const;
  [[nodiscard]] Held grip_to_push(std::size_t index, double gap_m) const;

  Role role_;
  PropStage& stage_;
  Timeline timeline_;
  double now_s_ = 0.0;
  double round_begin_s_ = 0.0;
  std::size_t next_action_ = 0;
  bool is_done_ = false;
  FloorPose here_;
  std::optional<std::size_t> seat_;  ///< prop that is sat on
  std::optional<Sitting> sitting_;
  std::optional<Held> held_;
};

}  // namespace tsg::simulation
