#pragma once

#include <optional>
#include <unordered_set>

#include "services/slam/lib/loop_verifier.hpp"
#include "services/slam/lib/place_index.hpp"

namespace tsg {

/// The newest keyframe shows a place that was mapped before.
struct Loop {
  KeyframeId newest = 0;
  KeyframeId seen_before = 0;
  SE3 T_before_newest;  ///< where the newest is, seen from the other
  SE3 T_world_newest;   ///< the same in the map as it is around the other
};

/// Watches keyframes for places seen before. A loop is reported once several keyframes in a row,
/// each by itself, tell the same correction of the map, and the correction is not more than the
/// path since can have drifted: places that are built alike are further apart than that, or show
/// their difference as the camera moves on. Between parts of the map nothing is known of the path.
/// Deterministic; not thread-safe: LoopCloser owns it.
class LoopDetector {
 public:
  LoopDetector(const ObservationModel& model, const SlamConfig& config)
      : model_(model), config_(config) {}

  /// To be called for each keyframe once it is adjusted to its neighbours.
  [[nodiscard]] std::optional<Loop> detect(const Map& map,
                                           const PlaceIndex& index,
                                           KeyframeId newest);

  /// The map has been moved: what was learnt of it is void.
  void reset() { suspicion_.reset(); }

 private:
  /// A loop that is not certain yet.
  struct Suspicion {
    MapPart part = 0;  ///< that the place seen before is in
    SE3 T_corrected_world;
    int confirmations = 0;
    int misses = 0;
  };
  [[nodiscard]] std::optional<VerifiedView> look_up(
      const Map& map,
      const PlaceIndex& index,
      const Keyframe& newest,
      const std::unordered_set<KeyframeId>& connected) const;
  [[nodiscard]] std::optional<VerifiedView> follow_up(
      const Map& map,
      const Keyframe& newest,
      const std::unordered_set<KeyframeId>& connected) const;
  [[nodiscard]] std::unordered_set<KeyframeId> connected_with(const Map& map,
                                                              const Keyframe& newest) const;
  [[nodiscard]] bool is_plausible(const Map& map,
                                  const Keyframe& newest,
                                  const VerifiedView& view) const;
  void weigh(const Map& map, const Keyframe& newest, const VerifiedView& view);
  void miss();

  const ObservationModel& model_;
  const SlamConfig& config_;
  std::optional<Suspicion> suspicion_;
};

}  // namespace tsg
