#pragma once

#include <algorithm>
#include <cstddef>

#include "common/bus/roudi_pools.hpp"  // generated from config/roudi.toml by CMake

namespace tsg {

/// Bytes of a chunk that are not the sample's: Cyclone's header, and room to align the sample.
inline constexpr std::size_t kChunkOverheadBytes = 256;

/// Whether a sample of that size can be had from RouDi as shipped. A larger one would not be
/// refused: iceoryx aborts the process that asks for it.
[[nodiscard]] constexpr bool fits_a_pool(std::size_t sample_bytes) {
  return std::any_of(kRoudiPools.begin(), kRoudiPools.end(), [&](const RoudiPool& pool) {
    return sample_bytes + kChunkOverheadBytes <= pool.chunk_bytes;
  });
}

}  // namespace tsg
