#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tsg::simulation {

inline constexpr double kPi = std::numbers::pi;

/// From 0 at `progress` <= 0 to 1 at `progress` >= 1, starting and stopping gently.
[[nodiscard]] inline double eased(double progress) {
  const double u = std::clamp(progress, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

/// The same angle within -pi..pi.
[[nodiscard]] inline double wrapped(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * kPi);
}

template <typename T>
[[nodiscard]] T mixed_values(const T& from, const T& to, double share) {
  return from + (to - from) * share;
}

}  // namespace tsg::simulation
