#pragma once

namespace tsg {

/// What one frame says of an instance.
struct MotionCounts {
  int features_moved = 0;
  int features_still = 0;
  int cells_appeared = 0;  ///< where the sensor had seen through
  int cells_same = 0;
};

/// The probability that an instance moves, by all frames so far. A push is believed within a few
/// frames, that it has come to rest only after about a second: between two pushes a chair is still
/// in somebody's hands.
class MotionEvidence {
 public:
  void add(const MotionCounts& counts);

  [[nodiscard]] bool is_moving() const { return is_moving_; }
  /// Whether at any time there was no doubt that it moves.
  [[nodiscard]] bool was_certain() const { return was_certain_; }
  [[nodiscard]] double probability() const;

 private:
  double log_odds_ = -1.0;  // things that may move mostly stand
  bool is_moving_ = false;
  bool was_certain_ = false;
};

}  // namespace tsg
