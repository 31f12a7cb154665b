#include "common/simulation/random.hpp"

#include <cmath>
#include <numbers>

namespace tsg::simulation {

std::uint64_t mixed(std::uint64_t value) {
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31U);
}

std::uint64_t Random::next() {
  state_ += 0x9E3779B97F4A7C15ULL;
  return mixed(state_);
}

double Random::uniform(double low, double high) {
  constexpr double kScale = 0x1.0p-53;  // 53 random bits make a double of 0..1
  return low + (high - low) * static_cast<double>(next() >> 11U) * kScale;
}

int Random::integer(int low, int high) {
  const auto choices = static_cast<std::uint64_t>(high - low) + 1;
  return low + static_cast<int>(next() % choices);
}

double Random::normal() {
  // Box-Muller; 1 - u keeps the logarithm finite.
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(0.0, 1.0));
}

std::uint64_t seed_of(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = mixed(seed + 0x9E3779B97F4A7C15ULL);
  for (const char letter : name) {
    hash = mixed(hash ^ static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
  }
  return hash;
}

}  // namespace tsg::simulation
