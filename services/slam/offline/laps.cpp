#include "services/slam/offline/laps.hpp"

namespace tsg {

Laps Laps::of(const TumFolder& sequence, int count) {
  const std::int64_t first_ns = sequence.frames.front().stamp_ns;
  const std::int64_t span_ns = sequence.frames.back().stamp_ns - first_ns;
  const auto steps = static_cast<std::int64_t>(sequence.frames.size()) - 1;
  // From the last frame to the first of the next lap it is a step like any other.
  return {
      .first_ns = first_ns, .length_ns = steps > 0 ? span_ns + span_ns / steps : 0, .count = count};
}

Trajectory Laps::repeat(const Trajectory& truth) const {
  if (count == 1) return truth;
  Trajectory repeated;
  for (int lap = 0; lap < count; ++lap) {
    for (const StampedPose& pose : truth) {
      if (pose.stamp_ns < first_ns || pose.stamp_ns >= first_ns + length_ns) continue;
      repeated.push_back({stamp_ns(lap, pose.stamp_ns), pose.T_world_camera});
    }
  }
  return repeated;
}

}  // namespace tsg
