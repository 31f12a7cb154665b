#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tsg {

/// What belongs together, as indices into two series of stamps.
struct StampPair {
  std::size_t first = 0;
  std::size_t second = 0;
  bool operator==(const StampPair&) const = default;
};

/// 20 ms: what the TUM tools use for images and poses alike.
inline constexpr std::int64_t kDefaultMaxDifferenceNs = 20'000'000;

/// Pairs stamps that differ by at most `max_difference_ns`: closest pairs first, each stamp used
/// once, ties in favour of the earlier stamp. Both series sorted; pairs come in order of `first`.
[[nodiscard]] std::vector<StampPair> associate(std::span<const std::int64_t> first,
                                               std::span<const std::int64_t> second,
                                               std::int64_t max_difference_ns);

}  // namespace tsg
