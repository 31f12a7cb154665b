#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tsg::simulation {

/// Many numbers of a normal distribution (mean 0, standard deviation 1), drawn once: a row of an
/// image takes a stretch of them at a place of its own.
class NoiseTable {
 public:
  explicit NoiseTable(std::uint64_t seed);

  /// `count` numbers (at most kMaxCount) for what `key` names: the same key, the same numbers.
  [[nodiscard]] std::span<const float> stretch(std::uint64_t key, std::size_t count) const;

  static constexpr std::size_t kMaxCount = std::size_t{1} << 14U;

 private:
  std::vector<float> values_;
};

/// A key for one row of one frame and one purpose.
[[nodiscard]] std::uint64_t noise_key(std::uint64_t frame,
                                      std::uint64_t row,
                                      std::uint64_t purpose);

}  // namespace tsg::simulation
