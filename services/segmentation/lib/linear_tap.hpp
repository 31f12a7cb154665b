#pragma once

#include <algorithm>

namespace tsg {

/// A position between two neighbouring samples of a row: linear interpolation takes
/// (1 - weight_of_second) * first + weight_of_second * second.
struct LinearTap {
  int first = 0;
  int second = 0;
  float weight_of_second = 0.0F;
};

/// The tap at `position` (sample centres are whole numbers) of a row of `length` samples; outside
/// it the edge goes on.
[[nodiscard]] inline LinearTap linear_tap(double position, int length) {
  const double inside = std::clamp(position, 0.0, static_cast<double>(length - 1));
  const int first = static_cast<int>(inside);
  return {.first = first,
          .second = std::min(first + 1, length - 1),
          .weight_of_second = static_cast<float>(inside - first)};
}

}  // namespace tsg
