#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "services/slam/lib/full_adjustment.hpp"
#include "services/slam/lib/loop_correction.hpp"
#include "services/slam/lib/loop_detector.hpp"
#include "services/slam/lib/place_index.hpp"

namespace tsg {

/// Finds loops and takes the drift that they show out of the map: pose graph at once, then full
/// adjustment as time permits. Deterministic where it is not interrupted; not thread-safe:
/// LocalMapper owns it. `model` and `config` must outlive it.
class LoopCloser {
 public:
  LoopCloser(const ObservationModel& model, const SlamConfig& config);

  void add(const Keyframe& keyframe);
  /// A keyframe leaves the map; what is known of it passes on to `parent`.
  void remove(KeyframeId id, KeyframeId parent, const SE3& T_parent_camera);

  /// The loops that were closed so far.
  [[nodiscard]] const std::vector<LoopEdge>& loops() const { return loops_; }
  /// Takes over a map that was kept: its keyframes, its loops, and whether a full adjustment is
  /// due.
  void take_over(const Map& map, std::vector<LoopEdge> loops, bool is_adjusting);

  /// Looks whether `newest` closes a loop, and if so corrects the map; where it shows a place of
  /// another part of the map, the two become one (merge_parts_of). True if the map was moved.
  bool close(Map& map,
             KeyframeId newest,
             MapPart main_part,
             const std::function<bool()>& must_stop);

  /// Whether a full adjustment has been begun or is due.
  [[nodiscard]] bool is_adjusting() const { return adjustment_.has_value(); }
  /// Goes on with it until `must_stop` (may be empty) says so. True if the map was moved.
  bool adjust(Map& map, const std::function<bool()>& must_stop);

  /// Keyframes that may show the view, the likeliest first.
  [[nodiscard]] std::vector<PlaceCandidate> recall(const Features& features) const;

 private:
  const ObservationModel& model_;
  const SlamConfig& config_;
  PlaceIndex index_;
  LoopDetector detector_;
  std::vector<LoopEdge> loops_;
  std::optional<FullAdjustment> adjustment_;
};

}  // namespace tsg
