#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tsg {

/// `value` with `digits` after the point: "12.30".
[[nodiscard]] std::string fixed(double value, int digits);

/// "812 B", "21.3 kB", "4.0 MB": powers of 1000, as file managers show them.
[[nodiscard]] std::string format_bytes(std::uint64_t bytes);

/// "0:07", "12:34", "1:02:03".
[[nodiscard]] std::string format_duration(double seconds);

/// Rows of cells as aligned columns, two spaces between them, no trailing spaces; every line
/// begins with `indent` spaces. Rows may be of different lengths.
[[nodiscard]] std::string format_table(const std::vector<std::vector<std::string>>& rows,
                                       int indent = 0);

/// Characters that a UTF-8 string shows, for alignment; wide characters count as one.
[[nodiscard]] std::size_t display_width(const std::string& text);

}  // namespace tsg
