#pragma once

namespace tsg {

/// What Tracker::track() spends its time on; each may begin several times in one frame.
enum class TrackingStage { kMatch, kOptimise, kDecide };

}  // namespace tsg
