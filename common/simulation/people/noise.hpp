#pragma once

#include <cstdint>

namespace tsg::simulation {

/// Smooth chance of 0..1 over the plane: values of a lattice of side 1, interpolated.
/// Deterministic.
[[nodiscard]] double noise(std::uint64_t seed, double x, double y);

}  // namespace tsg::simulation
