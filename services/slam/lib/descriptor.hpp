#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace tsg {

/// 256 brightness comparisons around a corner, turned into its direction.
using Descriptor = std::array<std::uint64_t, 4>;

/// Number of comparisons that came out differently, 0..256.
[[nodiscard]] inline int hamming_distance(const Descriptor& a, const Descriptor& b) {
  return std::popcount(a[0] ^ b[0]) + std::popcount(a[1] ^ b[1]) + std::popcount(a[2] ^ b[2]) +
         std::popcount(a[3] ^ b[3]);
}

}  // namespace tsg
