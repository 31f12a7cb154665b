#pragma once

#include <cstdint>
#include <limits>

namespace tsg {

using KeyframeId = std::uint64_t;  ///< counts up from 0 as tracking proposes them
using PointId = std::uint64_t;     ///< of a map point; never used twice
/// Keyframes of one part of the map know where they are to each other. A new part begins where the
/// camera is lost for long, and ends where it is found to show a place of another. Its name is the
/// id of the keyframe that began it, which is never culled.
using MapPart = std::uint32_t;

[[nodiscard]] inline MapPart part_begun_by(KeyframeId id) { return static_cast<MapPart>(id); }

inline constexpr PointId kNoPoint = std::numeric_limits<PointId>::max();

}  // namespace tsg
