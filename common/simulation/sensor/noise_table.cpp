#include "common/simulation/sensor/noise_table.hpp"

#include "common/core/check.hpp"
#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

constexpr std::size_t kValues = std::size_t{1} << 18U;

}  // namespace

NoiseTable::NoiseTable(std::uint64_t seed) {
  Random random(seed_of(seed, "noise"));
  values_.resize(kValues + kMaxCount);  // so that a stretch may start anywhere in kValues
  for (float& value : values_) value = static_cast<float>(random.normal());
}

std::span<const float> NoiseTable::stretch(std::uint64_t key, std::size_t count) const {
  TSG_CHECK(count <= kMaxCount);
  return std::span(values_).subspan(mixed(key) % kValues, count);
}

std::uint64_t noise_key(std::uint64_t frame, std::uint64_t row, std::uint64_t purpose) {
  return mixed(mixed(frame + 1) ^ (row << 8U) ^ purpose);
}

}  // namespace tsg::simulation
