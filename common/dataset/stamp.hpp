#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tsg {

/// Seconds in decimal ("1305031453.359684", "1.305e+09") as nanoseconds. Exact: digits never pass
/// through a double; what lies beyond nanoseconds is rounded. Nothing where the text is not a
/// number or does not fit.
[[nodiscard]] std::optional<std::int64_t> parse_stamp_ns(std::string_view seconds);

/// How many digits of a second a file carries; microseconds are what the TUM files have.
enum class StampDecimals { kMicroseconds = 6, kNanoseconds = 9 };

/// Seconds in decimal with a fixed number of decimals, rounded.
[[nodiscard]] std::string format_stamp(std::int64_t stamp_ns, StampDecimals decimals);

}  // namespace tsg
