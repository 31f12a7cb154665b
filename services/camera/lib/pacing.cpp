#include "services/camera/lib/pacing.hpp"

#include <cmath>

namespace tsg {

ReplayPacer::ReplayPacer(std::int64_t first_stamp_ns, std::int64_t start_ns, double fps)
    : offset_ns_(start_ns - first_stamp_ns),
      period_ns_(static_cast<std::int64_t>(std::llround(1e9 / fps))) {}

std::int64_t ReplayPacer::due_ns(std::int64_t stamp_ns) const { return stamp_ns + offset_ns_; }

Timing ReplayPacer::timing(std::int64_t stamp_ns, std::int64_t now_ns) const {
  const std::int64_t behind_ns = now_ns - due_ns(stamp_ns);
  if (behind_ns < 0) return Timing::kEarly;
  return behind_ns <= period_ns_ ? Timing::kDue : Timing::kLate;
}

}  // namespace tsg
