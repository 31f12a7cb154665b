#pragma once

#include <cstdint>
#include <string_view>

namespace tsg::simulation {

/// Numbers that look random and are the same on every machine, unlike those of <random>'s
/// distributions. SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t next();
  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] int integer(int low, int high);  ///< both ends included
  [[nodiscard]] double normal();                 ///< mean 0, standard deviation 1
  [[nodiscard]] bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

 private:
  std::uint64_t state_;
};

/// One number of all bits of `value`: for pixels and names that need chance of their own.
[[nodiscard]] std::uint64_t mixed(std::uint64_t value);

/// A seed for the thing called `name` in a scene with `seed`.
[[nodiscard]] std::uint64_t seed_of(std::uint64_t seed, std::string_view name);

}  // namespace tsg::simulation
