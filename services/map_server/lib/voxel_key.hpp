#pragma once

#include <cstdint>

namespace tsg {

/// A cell of a grid as one number: so many bits for each axis, x lowest, counted from
/// -kVoxelKeyOffset, so that cells of +-2^20 along each axis have a key.
inline constexpr unsigned kVoxelKeyBits = 21;
inline constexpr std::int64_t kVoxelKeyOffset = std::int64_t{1} << (kVoxelKeyBits - 1);
inline constexpr std::uint64_t kVoxelKeyMask = (std::uint64_t{1} << kVoxelKeyBits) - 1;

}  // namespace tsg
