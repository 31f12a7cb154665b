#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace tsg {

/// Lines of a log that an error message quotes.
inline constexpr std::size_t kLogLinesShown = 8;

/// The last `lines` lines of a text file, each indented, for an error message; says so where the
/// file is empty or cannot be read.
[[nodiscard]] std::string log_tail(const std::filesystem::path& path, std::size_t lines);

}  // namespace tsg
