#pragma once

#include <cstdint>

namespace tsg {

/// Whether it is time for a frame.
enum class Timing {
  kEarly,  ///< wait
  kDue,    ///< send
  kLate,   ///< more than a frame period behind: drop
};

/// Maps the stamps of a recording to the present, so that frames go out at the rate at which they
/// were taken. Clock values are any monotonic clock's.
class ReplayPacer {
 public:
  /// The frame of `first_stamp_ns` is due at `start_ns`; `fps` gives the frame period.
  ReplayPacer(std::int64_t first_stamp_ns, std::int64_t start_ns, double fps);

  /// When the frame of that stamp is due.
  [[nodiscard]] std::int64_t due_ns(std::int64_t stamp_ns) const;
  [[nodiscard]] Timing timing(std::int64_t stamp_ns, std::int64_t now_ns) const;

 private:
  std::int64_t offset_ns_;  // clock minus stamp
  std::int64_t period_ns_;
};

}  // namespace tsg
