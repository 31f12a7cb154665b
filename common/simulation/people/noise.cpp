#include "common/simulation/people/noise.hpp"

#include <cmath>

#include "common/simulation/people/easing.hpp"
#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

double lattice(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  const auto cell = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^
                    static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL;
  return static_cast<double>(mixed(seed ^ mixed(cell)) >> 11U) * 0x1.0p-53;
}

}  // namespace

double noise(std::uint64_t seed, double x, double y) {
  const auto x0 = static_cast<std::int64_t>(std::floor(x));
  const auto y0 = static_cast<std::int64_t>(std::floor(y));
  const double u = eased(x - static_cast<double>(x0));
  const double v = eased(y - static_cast<double>(y0));
  return mixed_values(mixed_values(lattice(seed, x0, y0), lattice(seed, x0 + 1, y0), u),
                      mixed_values(lattice(seed, x0, y0 + 1), lattice(seed, x0 + 1, y0 + 1), u), v);
}

}  // namespace tsg::simulation
