#pragma once

#include <cstdint>
#include <limits>

namespace tsg {

using KeyframeId = std::uint64_t;  ///< counts up from 0 as tracking proposes them
using PointId = std::uint64_t;     ///< of a map point; never used twice

inline constexpr PointId kNoPoint = std::numeric_limits<PointId>::max();

}  // namespace tsg
