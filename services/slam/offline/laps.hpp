#pragma once

#include <cstdint>

#include "common/dataset/tum_folder.hpp"
#include "common/geometry/stamped_pose.hpp"

namespace tsg {

/// A sequence gone round several times, its stamps going on: a long run from a short recording
/// whose path ends where it begins.
struct Laps {
  std::int64_t first_ns = 0;   ///< stamp of the sequence's first frame
  std::int64_t length_ns = 0;  ///< from the first frame of a lap to the first of the next
  int count = 1;

  /// Of all frames of `sequence`, which must have two where `count` is more than one.
  [[nodiscard]] static Laps of(const TumFolder& sequence, int count);

  [[nodiscard]] std::int64_t stamp_ns(int lap, std::int64_t recorded_ns) const {
    return recorded_ns + lap * length_ns;
  }
  /// The part of the truth that belongs to the sequence, in each lap. A single lap keeps all of it.
  [[nodiscard]] Trajectory repeat(const Trajectory& truth) const;
};

}  // namespace tsg
